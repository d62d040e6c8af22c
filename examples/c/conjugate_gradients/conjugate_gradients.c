/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Conjugate gradients with bitwise identical iterations on any number of ranks. The program solves
 * -Laplace u = 1 in the unit disc with u = 0 on its boundary, by linear finite elements. The
 * iterations are identical for three reasons: the nodes are identical, every row of the matrix is
 * assembled and multiplied in the order of node ids, and the dot products are those of the library,
 * which are exact sums, rounded once. The update of the ghosts overlaps with the multiplication of
 * the rows that need no ghost.
 *
 *   mpirun -np 4 ./conjugate_gradients
 *
 * Results to check: all digits of the residuals are the same on any number of ranks. The solution
 * is u = (1 - r^2) / 4, whose integral is pi / 8. Its second derivatives are 1/2, so linear
 * interpolation on equilateral triangles has an error of at most d^2 / 12. The chords of the
 * boundary deviate from it by up to d^2 / 8, where u has a slope of 1/2, and add d^2 / 16.
 */
#include <math.h>
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>
#include <stdio.h>
#include <stdlib.h>

#define PI 3.14159265358979323846
static const double d = 0.04;

/* The mesh of this rank. Arrays over `all` hold the owned nodes first, then the ghosts, which are
 * nearby nodes that other ranks own. */
typedef struct {
  int64_t owned, all; /* all = owned + ghosts */
  double *xy;         /* [all][2] */
  int64_t *ids;       /* [all] */
  int32_t *tags;      /* [all] */
} mesh;

/* One off-diagonal entry of a row: the matrix value for node `column`, and a sixth of the area of
 * the triangles on both sides of the edge to that node. */
typedef struct {
  int64_t id, column;
  double value, area;
} entry;

/* The matrix rows and the load of the owned nodes. Rows that need no ghost come first in `order`.
 */
typedef struct {
  int64_t *offsets, *order, without_ghosts;
  entry *entries;
  double *diagonal, *load;
} matrix;

static pnpbs_context context;
static pnpbs_placement placement;

static void check(pnpbs_status status) {
  if (status < 0) {
    fprintf(stderr, "%s: %s\n", pnpbs_status_string(status), pnpbs_last_error(context));
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
}

/* Returns zeroed memory for at least n entries, or aborts. */
static void *room(int64_t n, size_t size) {
  void *memory = calloc((size_t)n + 1, size);
  if (memory == NULL) MPI_Abort(MPI_COMM_WORLD, 1);
  return memory;
}

/* ---------------------------------------------------------------- the matrix ------------- */

static void get_mesh(mesh *m) {
  int64_t ghosts;
  check(pnpbs_placement_count(placement, &m->owned));
  check(pnpbs_placement_ghost_count(placement, &ghosts));
  m->all = m->owned + ghosts;
  m->xy = room(2 * m->all, sizeof(double));
  m->ids = room(m->all, sizeof(int64_t));
  m->tags = room(m->all, sizeof(int32_t));
  check(pnpbs_placement_get_nodes(placement, m->owned, m->xy, m->ids, m->tags, NULL));
  check(pnpbs_placement_get_ghosts(placement, ghosts, m->xy + 2 * m->owned, m->ids + m->owned,
                                   m->tags + m->owned, NULL, NULL));
}

/* Returns the cotangent of the angle at a in the triangle a, b, c, and its area. Exchanging b and c
 * does not change any bit, because products and sums of two numbers do not depend on their order.
 */
static double cotangent(const double *a, const double *b, const double *c, double *area) {
  const double bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1];
  const double twice_area = fabs(bx * cy - by * cx);
  *area = twice_area / 2;
  return (bx * cx + by * cy) / twice_area;
}

/* Adds the contribution of the triangle (i, k, other) to the entry of row i for node k. An entry
 * has at most two contributions, so their order does not matter. */
static void add_triangle(const mesh *m, int64_t i, entry *k, int64_t other) {
  double area;
  k->value -= cotangent(m->xy + 2 * other, m->xy + 2 * i, m->xy + 2 * k->column, &area) / 2;
  k->area += area / 6;
}

static int by_id(const void *a, const void *b) {
  const int64_t i = ((const entry *)a)->id, j = ((const entry *)b)->id;
  return (i > j) - (i < j);
}

/* Assembles the rows of the owned nodes from their Delaunay stars. For linear elements the integral
 * of grad phi_i . grad phi_j over a triangle is -1/2 times the cotangent of the angle opposite to
 * the edge ij, every row sums to zero, and the integral of phi_i is a third of the area around node
 * i. Collective. */
static void assemble(const mesh *m, matrix *a) {
  int64_t entries, i, k, *columns;
  int8_t *triangle;
  check(pnpbs_placement_star_size(placement, &entries));
  a->offsets = room(m->owned + 1, sizeof(int64_t));
  a->order = room(m->owned, sizeof(int64_t));
  a->entries = room(entries, sizeof(entry));
  a->diagonal = room(m->owned, sizeof(double));
  a->load = room(m->owned, sizeof(double));
  columns = room(entries, sizeof(int64_t));
  triangle = room(entries, sizeof(int8_t));
  check(pnpbs_placement_get_stars(placement, entries, a->offsets, columns, triangle));
  for (k = 0; k < entries; ++k) {
    a->entries[k].column = columns[k];
    a->entries[k].id = m->ids[columns[k]];
  }
  for (i = 0; i < m->owned; ++i) {
    const int64_t begin = a->offsets[i], end = a->offsets[i + 1];
    for (k = begin; k < end; ++k) {
      const int64_t next = k + 1 < end ? k + 1 : begin;
      if (!triangle[k]) continue; /* a gap outside the domain */
      add_triangle(m, i, &a->entries[k], columns[next]);
      add_triangle(m, i, &a->entries[next], columns[k]);
    }
    qsort(a->entries + begin, (size_t)(end - begin), sizeof(entry), by_id);
    for (k = begin; k < end; ++k) {
      a->diagonal[i] -= a->entries[k].value;
      a->load[i] += a->entries[k].area;
    }
  }
  free(columns);
  free(triangle);
}

/* Returns 1 if row i has an entry for a ghost, otherwise 0. */
static int needs_ghosts(const mesh *m, const matrix *a, int64_t i) {
  int64_t k;
  for (k = a->offsets[i]; k < a->offsets[i + 1]; ++k)
    if (a->entries[k].column >= m->owned) return 1;
  return 0;
}

/* Sorts the rows without ghosts before the others, which makes the overlap in multiply possible. */
static void order_rows(const mesh *m, matrix *a) {
  int64_t i, at = 0;
  int ghosts;
  for (ghosts = 0; ghosts < 2; ++ghosts) {
    for (i = 0; i < m->owned; ++i)
      if (needs_ghosts(m, a, i) == ghosts) a->order[at++] = i;
    if (ghosts == 0) a->without_ghosts = at;
  }
}

/* ---------------------------------------------------------------- the solver ------------- */

/* Computes the rows order[begin] .. order[end - 1] of y = A x, each in the order of ids. On the
 * boundary y is 0, because u does not change there. */
static void multiply_rows(const mesh *m, const matrix *a, int64_t begin, int64_t end,
                          const double *x, double *y) {
  int64_t r, k;
  for (r = begin; r < end; ++r) {
    const int64_t i = a->order[r];
    double sum = a->diagonal[i] * x[i];
    for (k = a->offsets[i]; k < a->offsets[i + 1]; ++k)
      sum += a->entries[k].value * x[a->entries[k].column];
    y[i] = m->tags[i] != 0 ? 0 : sum;
  }
}

/* Computes y = A x at the owned nodes. The rows without ghosts are multiplied while the values of
 * the ghosts are being sent. Collective. */
static void multiply(const mesh *m, const matrix *a, double *x, double *y) {
  check(pnpbs_placement_begin_update_ghosts(placement, m->all, 1, x));
  multiply_rows(m, a, 0, a->without_ghosts, x, y);
  check(pnpbs_placement_end_update_ghosts(placement, m->all, 1, x));
  multiply_rows(m, a, a->without_ghosts, m->owned, x, y);
}

static double dot(const mesh *m, const double *x, const double *y) {
  double product;
  check(pnpbs_placement_dot(placement, m->owned, 1, x, y, &product));
  return product;
}

/* Solves A u = load, starting from u = 0, and returns the number of iterations. Collective. */
static int solve(const mesh *m, const matrix *a, double *u, int rank) {
  double *r = room(m->owned, sizeof(double)), *q = room(m->owned, sizeof(double));
  double *p = room(m->all, sizeof(double)), rr, rr_before, start, alpha;
  int64_t i;
  int steps = 0;
  for (i = 0; i < m->owned; ++i) p[i] = r[i] = m->tags[i] != 0 ? 0 : a->load[i];
  start = rr = dot(m, r, r);
  while (rr > 1e-20 * start && steps < 1000) {
    ++steps;
    multiply(m, a, p, q);
    alpha = rr / dot(m, p, q);
    for (i = 0; i < m->owned; ++i) {
      u[i] += alpha * p[i];
      r[i] -= alpha * q[i];
    }
    rr_before = rr;
    rr = dot(m, r, r);
    for (i = 0; i < m->owned; ++i) p[i] = r[i] + rr / rr_before * p[i];
    if (rank == 0)
      printf("residual after step %d: %.17g, expected at most %g\n", steps, sqrt(rr / start), 20.0);
  }
  free(r);
  free(q);
  free(p);
  return steps;
}

/* ---------------------------------------------------------------- the program ------------ */

static double largest_error(const mesh *m, const double *u) {
  double part = 0, largest;
  int64_t i;
  for (i = 0; i < m->owned; ++i) {
    const double *x = m->xy + 2 * i;
    part = fmax(part, fabs(u[i] - (1 - x[0] * x[0] - x[1] * x[1]) / 4));
  }
  MPI_Allreduce(&part, &largest, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return largest;
}

int main(int argc, char **argv) {
  const double centre[2] = {0, 0};
  pnpbs_domain domain;
  mesh m;
  matrix a;
  double *u, integral, error;
  int64_t nodes;
  int rank, steps;

  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  check(pnpbs_context_create_mpi(MPI_COMM_WORLD, &context));
  check(pnpbs_domain_create(context, 2, &domain));
  check(pnpbs_domain_add_arc(domain, PNPBS_BOUNDARY, centre, 1, 0, 2 * PI, 1));
  check(pnpbs_placement_create(context, domain, &placement));
  check(pnpbs_placement_set_spacing_constant(placement, d));
  check(pnpbs_placement_run(placement));

  get_mesh(&m);
  assemble(&m, &a);
  order_rows(&m, &a);
  u = room(m.all, sizeof(double));
  steps = solve(&m, &a, u, rank);
  integral = dot(&m, a.load, u);
  error = largest_error(&m, u);
  check(pnpbs_placement_get_int64(placement, "nodes", &nodes));
  if (rank == 0) {
    /* Equilateral triangles with edges of length d fill the disc; each boundary node adds half. */
    printf("nodes: %ld, expected about %.0f\n", (long)nodes, 2 * PI / sqrt(3) / (d * d) + PI / d);
    printf("steps: %d, expected at most %d\n", steps, 200);
    printf("integral: %.17g, expected about %.5f\n", integral, PI / 8);
    printf("largest error: %.17g, expected at most %.8f\n", error, d * d / 12 + d * d / 16);
  }

  free(u), free(m.xy), free(m.ids), free(m.tags);
  free(a.offsets), free(a.order), free(a.entries), free(a.diagonal), free(a.load);
  pnpbs_placement_destroy(&placement);
  pnpbs_domain_destroy(&domain);
  pnpbs_context_destroy(&context);
  MPI_Finalize();
  return 0;
}
