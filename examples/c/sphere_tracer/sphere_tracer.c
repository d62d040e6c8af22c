/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Transport of a tracer on the whole sphere by finite volumes on Voronoi cells, with bitwise
 * identical results on any number of ranks. A cosine bell travels once around the Earth, over both
 * poles, in a wind of solid rotation (D. Williamson and others, Journal of Computational Physics
 * 102 (1992), 211-224, test 1).
 *
 *   mpirun -np 4 ./sphere_tracer
 *
 * The volumes of the cells are those of pnpbs_voronoi_create. The corners of a cell are the
 * circumcentres of the triangles of the star, in the order of the star. The flux through a face is
 * the difference of a stream function between its two corners, so the net flux of air out of each
 * cell is zero. Nodes, faces and their order do not depend on the number of ranks, and the owner of
 * a node computes the sum over the faces of its cell.
 *
 * Results to check: all digits are the same on any number of ranks. The mass of the tracer is
 * conserved up to rounding. After one revolution the bell is back at its start.
 */
#include <math.h>
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>
#include <stdio.h>
#include <stdlib.h>

#define PI 3.14159265358979323846
#define DAYS 12.0
static const double radius = 6371.22; /* kilometres, the unit of d */

/* The nodes of this rank. Arrays over `all` hold the owned nodes first, then the ghosts, which are
 * nearby nodes that other ranks own. */
typedef struct {
  int64_t owned, all; /* all = owned + ghosts */
  double *x;          /* [all][3] */
  int64_t *ids;       /* [all] */
  double *volumes;    /* [owned] areas of the cells, km^2 */
} cells;

/* The faces of the owned cells in compressed rows: the neighbours of cell i across its faces are
 * cells[offsets[i] .. offsets[i + 1] - 1], counter-clockwise. */
typedef struct {
  int64_t *offsets, *cells;
  double *fluxes;  /* [faces] flux out of the cell, km^2 per day */
  double *outward; /* [faces][3] outward normal times length, km */
} faces;

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

/* ---------------------------------------------------------------- the cells -------------- */

/* Evaluates the spacing: 100 km at the north pole, growing to 200 km at the south pole. */
static int32_t spacing(int64_t n, int32_t dim, const double *x, double *d, void *user) {
  int64_t i;
  (void)user;
  for (i = 0; i < n; ++i) d[i] = 150 - 50 * x[dim * i + 2] / radius;
  return 0;
}

static void place(void) {
  const double outside[3] = {0, 0, -1};
  pnpbs_domain sphere;
  check(pnpbs_domain_create_sphere(context, radius, outside, &sphere));
  check(pnpbs_placement_create(context, sphere, &placement));
  check(pnpbs_placement_set_spacing_callback(placement, spacing, NULL));
  check(pnpbs_placement_run(placement));
  pnpbs_domain_destroy(&sphere);
}

static void get_cells(cells *c) {
  int64_t ghosts;
  pnpbs_voronoi voronoi;
  check(pnpbs_placement_count(placement, &c->owned));
  check(pnpbs_placement_ghost_count(placement, &ghosts));
  c->all = c->owned + ghosts;
  c->x = room(3 * c->all, sizeof(double));
  c->ids = room(c->all, sizeof(int64_t));
  c->volumes = room(c->owned, sizeof(double));
  check(pnpbs_placement_get_nodes(placement, c->owned, c->x, c->ids, NULL, NULL));
  check(pnpbs_placement_get_ghosts(placement, ghosts, c->x + 3 * c->owned, c->ids + c->owned, NULL,
                                   NULL, NULL));
  check(pnpbs_voronoi_create(placement, &voronoi));
  check(pnpbs_voronoi_get_cells(voronoi, c->owned, c->volumes, NULL));
  pnpbs_voronoi_destroy(&voronoi);
}

/* Returns the stream function of solid rotation about an axis in the plane of the equator, in km^2
 * per day. The flux between two points of the sphere is its difference. */
static double stream(const double *x) { return 2 * PI / DAYS * radius * x[0]; }

/* Computes the circumcentre of three nodes on the sphere. The nodes are sorted by id first, so
 * their order affects no bit. */
static void corner(const cells *c, int64_t i, int64_t j, int64_t k, double *centre) {
  int64_t nodes[3] = {i, j, k}, swap;
  double u[3], v[3], n[3], length;
  int a, b;
  for (a = 0; a < 2; ++a)
    for (b = 0; b < 2 - a; ++b)
      if (c->ids[nodes[b]] > c->ids[nodes[b + 1]]) {
        swap = nodes[b];
        nodes[b] = nodes[b + 1];
        nodes[b + 1] = swap;
      }
  for (a = 0; a < 3; ++a) {
    u[a] = c->x[3 * nodes[1] + a] - c->x[3 * nodes[0] + a];
    v[a] = c->x[3 * nodes[2] + a] - c->x[3 * nodes[0] + a];
  }
  n[0] = u[1] * v[2] - u[2] * v[1];
  n[1] = u[2] * v[0] - u[0] * v[2];
  n[2] = u[0] * v[1] - u[1] * v[0];
  length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  if (n[0] * c->x[3 * i] + n[1] * c->x[3 * i + 1] + n[2] * c->x[3 * i + 2] < 0) length = -length;
  for (a = 0; a < 3; ++a) centre[a] = radius * n[a] / length;
}

/* Computes the outward normal of a face times its length: the vector between its corners, turned by
 * a right angle to the right. `up` is the position of the node. */
static void outward_of(const double *from, const double *to, const double *up, double *outward) {
  const double x = to[0] - from[0], y = to[1] - from[1], z = to[2] - from[2];
  outward[0] = (y * up[2] - z * up[1]) / radius;
  outward[1] = (z * up[0] - x * up[2]) / radius;
  outward[2] = (x * up[1] - y * up[0]) / radius;
}

/* Computes the faces of the owned cells. The corners of a face are the circumcentres of the two
 * triangles at the edge to its neighbour. Collective. */
static void get_faces(const cells *c, faces *f) {
  int64_t entries, i, k;
  check(pnpbs_placement_star_size(placement, &entries));
  f->offsets = room(c->owned + 1, sizeof(int64_t));
  f->cells = room(entries, sizeof(int64_t));
  f->fluxes = room(entries, sizeof(double));
  f->outward = room(3 * entries, sizeof(double));
  check(pnpbs_placement_get_stars(placement, entries, f->offsets, f->cells, NULL));
  for (i = 0; i < c->owned; ++i) {
    const int64_t begin = f->offsets[i], end = f->offsets[i + 1];
    for (k = begin; k < end; ++k) {
      const int64_t before = k > begin ? k - 1 : end - 1, next = k + 1 < end ? k + 1 : begin;
      double from[3], to[3];
      corner(c, i, f->cells[before], f->cells[k], from);
      corner(c, i, f->cells[k], f->cells[next], to);
      f->fluxes[k] = stream(to) - stream(from);
      outward_of(from, to, c->x + 3 * i, f->outward + 3 * k);
    }
  }
}

/* ---------------------------------------------------------------- the tracer ------------- */

/* Returns the initial tracer: a cosine bell around a point of the equator, with a third of the
 * radius as width. */
static double bell(const double *x) {
  const double way = radius * acos(fmax(-1, fmin(1, x[1] / radius))), width = radius / 3;
  return way < width ? 500 * (1 + cos(PI * way / width)) : 0;
}

/* Computes the gradient of q at the owned nodes by Gauss's theorem, and updates the ghosts.
 * Collective. */
static void gradient(const cells *c, const faces *f, const double *q, double *g) {
  int64_t i, k;
  int a;
  for (i = 0; i < c->owned; ++i) {
    double sum[3] = {0, 0, 0};
    for (k = f->offsets[i]; k < f->offsets[i + 1]; ++k)
      for (a = 0; a < 3; ++a) sum[a] += 0.5 * (q[f->cells[k]] - q[i]) * f->outward[3 * k + a];
    for (a = 0; a < 3; ++a) g[3 * i + a] = sum[a] / c->volumes[i];
  }
  check(pnpbs_placement_update_ghosts(placement, c->all, 3, g));
}

/* Returns q at the face between the upwind cell `out` and the cell `in`: a third of the value
 * extrapolated with the gradient of `out`, plus two thirds of the mean of both cells. The order is
 * three on regular cells. */
static double at_face(const cells *c, const double *q, const double *g, int64_t out, int64_t in) {
  double told = q[out];
  int a;
  for (a = 0; a < 3; ++a) told += 0.5 * g[3 * out + a] * (c->x[3 * in + a] - c->x[3 * out + a]);
  return (told + q[out] + q[in]) / 3;
}

/* Computes the rate of change of q at the owned nodes, which is the net inflow through the faces
 * over the volume. Updates the ghosts of q. Collective. */
static void rate(const cells *c, const faces *f, double *q, double *g, double *dq) {
  int64_t i, k;
  check(pnpbs_placement_update_ghosts(placement, c->all, 1, q));
  gradient(c, f, q, g);
  for (i = 0; i < c->owned; ++i) {
    double in = 0;
    for (k = f->offsets[i]; k < f->offsets[i + 1]; ++k) {
      const int64_t j = f->cells[k];
      const double flux = f->fluxes[k];
      in -= flux * (flux > 0 ? at_face(c, q, g, i, j) : at_face(c, q, g, j, i));
    }
    dq[i] = in / c->volumes[i];
  }
}

/* Advances q by one step (in days) of the classical Runge-Kutta method. Collective. */
static void advance(const cells *c, const faces *f, double step, double *q) {
  static const double ahead[4] = {0, 0.5, 0.5, 1}, weight[4] = {1. / 6, 1. / 3, 1. / 3, 1. / 6};
  double *stage = room(c->all, sizeof(double)), *dq = room(c->owned, sizeof(double));
  double *sum = room(c->owned, sizeof(double)), *g = room(3 * c->all, sizeof(double));
  int64_t i;
  int s;
  for (s = 0; s < 4; ++s) {
    for (i = 0; i < c->owned; ++i) stage[i] = q[i] + ahead[s] * step * dq[i];
    rate(c, f, stage, g, dq);
    for (i = 0; i < c->owned; ++i) sum[i] += weight[s] * dq[i];
  }
  for (i = 0; i < c->owned; ++i) q[i] += step * sum[i];
  free(stage), free(dq), free(sum), free(g);
}

static double integral(const cells *c, const double *q) {
  double sum;
  check(pnpbs_placement_dot(placement, c->owned, 1, c->volumes, q, &sum));
  return sum;
}

/* Returns the root mean square error of q over the sphere, relative to the root mean square of the
 * bell. Collective. */
static double error(const cells *c, const double *q) {
  double *off = room(c->owned, sizeof(double)), *size = room(c->owned, sizeof(double)), result;
  int64_t i;
  for (i = 0; i < c->owned; ++i) {
    const double exact = bell(c->x + 3 * i);
    off[i] = (q[i] - exact) * (q[i] - exact);
    size[i] = exact * exact;
  }
  result = sqrt(integral(c, off) / integral(c, size));
  free(off), free(size);
  return result;
}

int main(int argc, char **argv) {
  cells c;
  faces f;
  double *q, *one, before, area;
  int64_t nodes, i;
  int rank, n, steps = 400;

  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  check(pnpbs_context_create_mpi(MPI_COMM_WORLD, &context));
  place();
  get_cells(&c);
  get_faces(&c, &f);
  q = room(c.all, sizeof(double));
  one = room(c.owned, sizeof(double));
  for (i = 0; i < c.owned; ++i) q[i] = bell(c.x + 3 * i), one[i] = 1;
  area = integral(&c, one);
  before = integral(&c, q);
  for (n = 0; n < steps; ++n) advance(&c, &f, DAYS / steps, q);
  check(pnpbs_placement_get_int64(placement, "nodes", &nodes));
  before = integral(&c, q) / before - 1;
  {
    const double off = error(&c, q);
    if (rank == 0) {
      printf("cells: %ld, expected about %d\n", (long)nodes, 29450);
      printf("area over that of the sphere, less 1: %.1e, expected at most %.0e\n",
             fabs(area / (4 * PI * radius * radius) - 1), 1e-12);
      printf("change of mass: %.1e, expected at most %.0e\n", fabs(before), 1e-12);
      printf("error after a turn: %.17g, expected at most %g\n", off, 0.2);
    }
  }

  free(q), free(one), free(c.x), free(c.ids), free(c.volumes);
  free(f.offsets), free(f.cells), free(f.fluxes), free(f.outward);
  pnpbs_placement_destroy(&placement);
  pnpbs_context_destroy(&context);
  MPI_Finalize();
  return 0;
}
