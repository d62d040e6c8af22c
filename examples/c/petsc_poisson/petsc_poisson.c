/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Solves -Laplace u = f with a known solution by linear finite elements in PETSc, on meshes that
 * are distributed from the start. A second solve uses nodes whose spacing is adapted to f. The
 * domains are a square with a hole and a box with a cavity, or the domain of a file.
 *
 *   petsc_poisson [FILE.poly|FILE.stl SPACING] [options of PETSc]
 */
#include <math.h>
#include <mpi.h>
#include <petscksp.h>
#include <pnpbs/pnpbs_mpi.h>
#include <string.h>

#include "pnpbs_petsc.h"

enum { OUTSIDE = 1, HOLE = 2, BODY = 3, NO_REGION = -1 };

/* ---------------------------------------------------------------- the problem ------------ */

/* The known solution u = 1 / (1 + r^2), where r is the distance from `centre` over `length`. The
 * conductivity is 1 in the cells whose label is `region`. */
typedef struct {
  int32_t dim;
  double centre[3], length;
  PetscInt region;
} peak;

static double square_of_r(const peak *p, const double *x) {
  double sum = 0;
  int k;
  for (k = 0; k < p->dim; ++k) sum += (x[k] - p->centre[k]) * (x[k] - p->centre[k]);
  return sum / (p->length * p->length);
}

static double solution(const peak *p, const double *x) { return 1 / (1 + square_of_r(p, x)); }

/* Returns f = -Laplace u. */
static double load(const peak *p, const double *x) {
  const double r2 = square_of_r(p, x), one = 1 + r2;
  return (2 * p->dim / (one * one) - 8 * r2 / (one * one * one)) / (p->length * p->length);
}

/* ---------------------------------------------------------------- finite elements --------- */

/* Numbers the unknowns, one at each vertex. */
static PetscErrorCode number_unknowns(DM dm) {
  PetscSection section;
  PetscInt begin, end, p;
  PetscFunctionBeginUser;
  PetscCall(PetscSectionCreate(PetscObjectComm((PetscObject)dm), &section));
  PetscCall(DMPlexGetChart(dm, &begin, &end));
  PetscCall(PetscSectionSetChart(section, begin, end));
  PetscCall(DMPlexGetDepthStratum(dm, 0, &begin, &end));
  for (p = begin; p < end; ++p) PetscCall(PetscSectionSetDof(section, p, 1));
  PetscCall(PetscSectionSetUp(section));
  PetscCall(DMSetLocalSection(dm, section));
  PetscCall(PetscSectionDestroy(&section));
  PetscFunctionReturn(0);
}

/* Evaluates a function at all vertices on this rank. Local. */
static PetscErrorCode values_at_vertices(DM dm, const peak *p,
                                         double (*of)(const peak *, const double *), Vec local) {
  Vec coordinates;
  const PetscScalar *x;
  PetscScalar *value;
  PetscInt n, i;
  PetscFunctionBeginUser;
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(VecGetArrayRead(coordinates, &x));
  PetscCall(VecGetArray(local, &value));
  PetscCall(VecGetLocalSize(local, &n));
  for (i = 0; i < n; ++i) value[i] = of(p, x + p->dim * i);
  PetscCall(VecRestoreArray(local, &value));
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscFunctionReturn(0);
}

/* Barycentric coordinates of quadrature rules of second order, by dimension: at point k, which is
 * the one next to corner k, the hat function of this corner is NEAR[dim], the others FAR[dim]. */
static const double NEAR[] = {0, 0, 2.0 / 3, 0.58541019662496852},
                    FAR[] = {0, 0, 1.0 / 6, 0.13819660112501051};
/* A cell: its area or volume, the gradients of the hat functions, and the quadrature points. */
typedef struct {
  double measure, gradient[4][3], point[4][3];
} element;

/* Returns the axis of PETSc's reference cell on which corner i > 0 lies. PETSc orients tetrahedra
 * in the opposite direction, so two of their corners are exchanged. */
static int axis_of(int dim, int i) { return dim == 3 && i < 3 ? 2 - i : i - 1; }

/* Computes the element of a cell. The sides of PETSc's reference cell have length 2, which explains
 * the factors. */
static PetscErrorCode element_of(DM dm, PetscInt cell, int dim, element *e) {
  PetscReal origin[3], jacobian[9], inverse[9], determinant;
  int i, k, c;
  PetscFunctionBeginUser;
  PetscCall(DMPlexComputeCellGeometryFEM(dm, cell, NULL, origin, jacobian, inverse, &determinant));
  e->measure = determinant * (dim == 2 ? 2.0 : 4.0 / 3);
  for (c = 0; c < dim; ++c) {
    e->gradient[0][c] = 0;
    for (i = 1; i <= dim; ++i) {
      e->gradient[i][c] = inverse[axis_of(dim, i) * dim + c] / 2;
      e->gradient[0][c] -= e->gradient[i][c];
    }
    for (k = 0; k <= dim; ++k) {
      e->point[k][c] = origin[c];
      for (i = 1; i <= dim; ++i)
        e->point[k][c] += 2 * jacobian[c * dim + axis_of(dim, i)] * (i == k ? NEAR[dim] : FAR[dim]);
    }
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode assemble(DM dm, const peak *p, Mat stiffness, Vec right) {
  PetscInt begin, end, cell;
  Vec local;
  int i, j, k;
  PetscFunctionBeginUser;
  PetscCall(DMGetLocalVector(dm, &local));
  PetscCall(VecSet(local, 0));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &begin, &end));
  for (cell = begin; cell < end; ++cell) {
    PetscScalar matrix[16] = {0}, vector[4] = {0};
    const int corners = p->dim + 1;
    PetscInt region;
    element e;
    PetscCall(DMGetLabelValue(dm, "Cell Sets", cell, &region));
    PetscCall(element_of(dm, cell, p->dim, &e));
    for (i = 0; i < corners; ++i) {
      for (j = 0; region == p->region && j < corners; ++j)
        for (k = 0; k < p->dim; ++k)
          matrix[corners * i + j] += e.measure * e.gradient[i][k] * e.gradient[j][k];
      for (k = 0; k < corners; ++k)
        vector[i] += e.measure / corners * load(p, e.point[k]) * (i == k ? NEAR : FAR)[p->dim];
    }
    PetscCall(DMPlexMatSetClosure(dm, NULL, NULL, stiffness, cell, matrix, ADD_VALUES));
    PetscCall(DMPlexVecSetClosure(dm, NULL, local, cell, vector, ADD_VALUES));
  }
  PetscCall(MatAssemblyBegin(stiffness, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(stiffness, MAT_FINAL_ASSEMBLY));
  PetscCall(DMLocalToGlobal(dm, local, ADD_VALUES, right));
  PetscCall(DMRestoreLocalVector(dm, &local));
  PetscFunctionReturn(0);
}

/* Computes the error in the L2 norm. Collective. */
static PetscErrorCode error_of(DM dm, const peak *p, Vec u, double *error) {
  PetscInt begin, end, cell;
  double square = 0;
  Vec local;
  int i, k;
  PetscFunctionBeginUser;
  PetscCall(DMGetLocalVector(dm, &local));
  PetscCall(DMGlobalToLocal(dm, u, INSERT_VALUES, local));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &begin, &end));
  for (cell = begin; cell < end; ++cell) {
    PetscScalar *at_corners = NULL;
    element e;
    PetscCall(element_of(dm, cell, p->dim, &e));
    PetscCall(DMPlexVecGetClosure(dm, NULL, local, cell, NULL, &at_corners));
    for (k = 0; k <= p->dim; ++k) {
      double difference = -solution(p, e.point[k]);
      for (i = 0; i <= p->dim; ++i) difference += at_corners[i] * (i == k ? NEAR : FAR)[p->dim];
      square += e.measure / (p->dim + 1) * difference * difference;
    }
    PetscCall(DMPlexVecRestoreClosure(dm, NULL, local, cell, NULL, &at_corners));
  }
  PetscCall(DMRestoreLocalVector(dm, &local));
  MPI_Allreduce(MPI_IN_PLACE, &square, 1, MPI_DOUBLE, MPI_SUM, PetscObjectComm((PetscObject)dm));
  *error = sqrt(square);
  PetscFunctionReturn(0);
}

/* Replaces the equations of the vertices on the boundary, which the label "marker" marks, by the
 * known values. Collective. */
static PetscErrorCode fix_boundary(DM dm, Mat stiffness, Vec known, Vec right) {
  DMLabel label;
  PetscSection section;
  PetscInt begin, end, p, value, rows = 0, *row;
  PetscFunctionBeginUser;
  PetscCall(DMGetLabel(dm, "marker", &label));
  PetscCall(DMPlexLabelComplete(dm, label)); /* adds the vertices of the faces */
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(DMPlexGetDepthStratum(dm, 0, &begin, &end));
  PetscCall(PetscMalloc1(end - begin, &row));
  for (p = begin; p < end; ++p) {
    PetscCall(DMLabelGetValue(label, p, &value));
    if (value == 1) PetscCall(PetscSectionGetOffset(section, p, &row[rows++]));
  }
  PetscCall(MatZeroRowsColumnsLocal(stiffness, rows, row, 1, known, right));
  PetscCall(PetscFree(row));
  PetscFunctionReturn(0);
}

static PetscErrorCode solve(DM dm, const peak *p, double *error) {
  Mat stiffness;
  Vec local, known, right, u;
  KSP ksp;
  PetscFunctionBeginUser;
  PetscCall(number_unknowns(dm));
  PetscCall(DMCreateMatrix(dm, &stiffness));
  PetscCall(DMCreateGlobalVector(dm, &right));
  PetscCall(VecDuplicate(right, &known));
  PetscCall(VecDuplicate(right, &u));
  PetscCall(VecSet(right, 0));
  PetscCall(assemble(dm, p, stiffness, right));
  PetscCall(DMGetLocalVector(dm, &local));
  PetscCall(values_at_vertices(dm, p, solution, local));
  PetscCall(DMLocalToGlobal(dm, local, INSERT_VALUES, known));
  PetscCall(DMRestoreLocalVector(dm, &local));
  PetscCall(fix_boundary(dm, stiffness, known, right));

  PetscCall(KSPCreate(PetscObjectComm((PetscObject)dm), &ksp));
  PetscCall(KSPSetOperators(ksp, stiffness, stiffness));
  PetscCall(KSPSetType(ksp, KSPCG));
  PetscCall(KSPSetTolerances(ksp, 1e-12, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(KSPSetFromOptions(ksp));
  PetscCall(KSPSolve(ksp, right, u));
  PetscCall(error_of(dm, p, u, error));
  PetscCall(KSPDestroy(&ksp));
  PetscCall(VecDestroy(&known));
  PetscCall(VecDestroy(&right));
  PetscCall(VecDestroy(&u));
  PetscCall(MatDestroy(&stiffness));
  PetscFunctionReturn(0);
}

/* ---------------------------------------------------------------- nodes ------------------- */

/* Reduces the spacing where f is large, by a factor of up to three, because the error of linear
 * elements is about |f| d^2. f is evaluated at the vertices of the plex and sent to the nodes of
 * the placement. Collective. */
static PetscErrorCode adapt(pnpbs_placement placement, DM dm, PetscSF nodes, const peak *p) {
  int64_t n = 0, i;
  double *d, *at_nodes, largest = 0;
  const PetscScalar *at_vertices;
  Vec local;
  PetscFunctionBeginUser;
  PnpbsCall(pnpbs_placement_count(placement, &n));
  PetscCall(PetscMalloc2(n, &d, n, &at_nodes));
  PnpbsCall(pnpbs_placement_get_nodes(placement, n, NULL, NULL, NULL, d));
  PetscCall(DMCreateLocalVector(dm, &local));
  PetscCall(values_at_vertices(dm, p, load, local));
  PetscCall(VecGetArrayRead(local, &at_vertices));
  PetscCall(PetscSFReduceBegin(nodes, MPIU_SCALAR, at_vertices, at_nodes, MPI_REPLACE));
  PetscCall(PetscSFReduceEnd(nodes, MPIU_SCALAR, at_vertices, at_nodes, MPI_REPLACE));
  PetscCall(VecRestoreArrayRead(local, &at_vertices));
  for (i = 0; i < n; ++i) largest = fmax(largest, fabs(at_nodes[i]));
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, PetscObjectComm((PetscObject)dm));
  for (i = 0; i < n; ++i) d[i] /= fmax(1, 3 * sqrt(fabs(at_nodes[i]) / largest));
  PnpbsCall(pnpbs_placement_set_spacing_at_nodes(placement, n, d));
  PetscCall(VecDestroy(&local));
  PetscCall(PetscFree2(d, at_nodes));
  PetscFunctionReturn(0);
}

static PetscErrorCode place_and_solve(pnpbs_placement placement, MPI_Comm comm, const peak *p,
                                      int adapts, int64_t *count, double *error) {
  pnpbs_mesh mesh;
  PetscSF nodes;
  DM dm;
  PetscFunctionBeginUser;
  PnpbsCall(pnpbs_placement_run(placement));
  PnpbsCall(pnpbs_mesh_create(placement, 0, &mesh));
  PnpbsCall(pnpbs_mesh_numbering(mesh, NULL, count, NULL, NULL));
  PetscCall(pnpbs_petsc_plex(mesh, comm, &dm, &nodes));
  PnpbsCall(pnpbs_mesh_destroy(&mesh));
  PetscCall(DMViewFromOptions(dm, NULL, "-dm_view"));
  PetscCall(solve(dm, p, error));
  if (adapts) PetscCall(adapt(placement, dm, nodes, p));
  PetscCall(PetscSFDestroy(&nodes));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(0);
}

static PetscErrorCode run(pnpbs_context context, pnpbs_domain domain, const peak *p, double d,
                          double errors[2]) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  pnpbs_placement placement;
  int64_t nodes;
  int k;
  PetscFunctionBeginUser;
  PnpbsCall(pnpbs_placement_create(context, domain, &placement));
  PnpbsCall(pnpbs_placement_set_spacing_constant(placement, d));
  for (k = 0; k < 2; ++k) {
    PetscCall(place_and_solve(placement, comm, p, k == 0, &nodes, &errors[k]));
    PetscCall(PetscPrintf(comm, "%d dimensions, %s: %lld nodes, error %.6g\n", (int)p->dim,
                          k == 0 ? "constant spacing" : "adapted", (long long)nodes, errors[k]));
  }
  PnpbsCall(pnpbs_placement_destroy(&placement));
  PetscFunctionReturn(0);
}

static PetscErrorCode square_with_hole(pnpbs_context context, double errors[2]) {
  const double square[] = {0, 0, 1, 0, 1, 1, 0, 1}, centre[] = {0.3, 0.35};
  const peak p = {2, {0.7, 0.6, 0}, 0.1, BODY};
  pnpbs_domain domain;
  PetscFunctionBeginUser;
  PnpbsCall(pnpbs_domain_create(context, 2, &domain));
  PnpbsCall(pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square, NULL, OUTSIDE));
  PnpbsCall(pnpbs_domain_add_arc(domain, PNPBS_BOUNDARY, centre, 0.2, 0, 2 * PETSC_PI, HOLE));
  PnpbsCall(pnpbs_domain_add_region(domain, p.centre, BODY));
  PetscCall(run(context, domain, &p, 0.03, errors));
  PnpbsCall(pnpbs_domain_destroy(&domain));
  PetscFunctionReturn(0);
}

static PetscErrorCode box_with_hollow(pnpbs_context context, double errors[2]) {
  const double low[] = {0, 0, 0}, high[] = {1, 1, 1}, centre[] = {0.3, 0.35, 0.5};
  const peak p = {3, {0.7, 0.6, 0.5}, 0.2, BODY};
  pnpbs_domain domain;
  PetscFunctionBeginUser;
  PnpbsCall(pnpbs_domain_create(context, 3, &domain));
  PnpbsCall(pnpbs_domain_add_box(domain, low, high, OUTSIDE));
  PnpbsCall(pnpbs_domain_add_ball(domain, centre, 0.2, HOLE));
  PnpbsCall(pnpbs_domain_add_region(domain, p.centre, BODY));
  PetscCall(run(context, domain, &p, 0.1, errors));
  PnpbsCall(pnpbs_domain_destroy(&domain));
  PetscFunctionReturn(0);
}

/* Solves in the domain of a file. The peak of u lies in the middle of the bounding box and has the
 * length of ten spacings. */
static PetscErrorCode domain_of_file(pnpbs_context context, const char *path, double d,
                                     double errors[2]) {
  peak p = {strstr(path, ".poly") ? 2 : 3, {0, 0, 0}, 10 * d, NO_REGION};
  double low[3], high[3];
  pnpbs_domain domain;
  int k;
  PetscFunctionBeginUser;
  PnpbsCall(pnpbs_domain_create(context, p.dim, &domain));
  if (p.dim == 2)
    PnpbsCall(pnpbs_domain_read_poly(domain, path));
  else
    PnpbsCall(pnpbs_domain_read_surface(domain, PNPBS_BOUNDARY, path, 40));
  PnpbsCall(pnpbs_domain_bounds(domain, low, high));
  for (k = 0; k < p.dim; ++k) p.centre[k] = (low[k] + high[k]) / 2;
  PetscCall(run(context, domain, &p, d, errors));
  PnpbsCall(pnpbs_domain_destroy(&domain));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv) {
  pnpbs_context context;
  double plane[2], space[2];
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PnpbsCall(pnpbs_context_create_mpi(PETSC_COMM_WORLD, &context));
  if (argc > 2 && argv[1][0] != '-') {
    PetscCall(domain_of_file(context, argv[1], atof(argv[2]), plane));
  } else {
    PetscCall(square_with_hole(context, plane));
    PetscCall(box_with_hollow(context, space));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "error in the plane: %.6g, expected at most %.6g\n",
                          plane[1], plane[0]));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "error in space: %.6g, expected at most %.6g\n",
                          space[1], space[0]));
  }
  PnpbsCall(pnpbs_context_destroy(&context));
  return PetscFinalize();
}
