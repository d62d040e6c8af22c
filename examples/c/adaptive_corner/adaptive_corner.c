/* SPDX-License-Identifier: BSD-3-Clause
 *
 * An adaptive loop on a live placement, over the ranks of an MPI program. Each round solves,
 * estimates the error, changes the spacing d and runs the placement again. The domain is an L, the
 * square (-1, 1)^2 without its lower right quarter. The problem -Laplace u = 0 has the solution
 * u = r^(2/3) sin(2 theta / 3), whose gradient is infinite at the re-entrant corner. As in
 * laplace_ring, the program assembles linear finite elements from the Delaunay stars and solves by
 * conjugate gradients.
 *
 *   mpirun -np 4 ./adaptive_corner [FOLDER]
 *
 * The error on each triangle is estimated, without the known solution, as the L2 distance between
 * the gradient of the finite element solution and a smoother gradient that is averaged over the
 * stars (Zienkiewicz and Zhu 1987). The new d distributes the error evenly over twice as many
 * nodes. The next run starts from the current nodes. If the work of the ranks is unequal
 * afterwards, it is repartitioned. No rank holds all nodes. If a folder is given, every rank writes
 * its piece of the last round into it; the folder must exist.
 *
 * Results to check, for linear elements and the energy norm, which is the root of the integral of
 * |grad error|^2: with N nodes and constant d the error falls as N^(-1/3) because of the corner. On
 * adapted nodes it falls as N^(-1/2), the rate of a smooth solution. The estimate is about as large
 * as the error.
 */
#include <math.h>
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>
#include <stdio.h>
#include <stdlib.h>

#define ROUNDS 6
#define FIRST_NODES 400.0 /* nodes of round 0; each round doubles the number */
#define PI 3.14159265358979323846
#define AREA 3.0
#define PERIMETER 8.0

/* The mesh of this rank. Arrays over `all` hold the owned nodes first, then the ghosts, which are
 * nearby nodes that other ranks own. */
typedef struct {
  MPI_Comm comm;
  int64_t owned, all;          /* all = owned + ghosts */
  double *xy;                  /* [all][2] */
  double *spacing;             /* [all] */
  int32_t *tags;               /* [all] */
  int64_t triangles, *corners; /* [triangles][3] */
} mesh;

/* The halo exchange pattern of pnpbs_placement_get_exchange, with message buffers. */
typedef struct {
  int32_t neighbours, *ranks;
  int64_t *send_offsets, *send_nodes, *receive_offsets, *receive_nodes;
  double *sent, *received;
  MPI_Request *requests;
} exchange;

/* The matrix rows of the owned nodes. Row i has a diagonal entry and one entry for each node of the
 * star of node i, at offsets[i] .. offsets[i + 1] - 1. */
typedef struct {
  int64_t *offsets, *columns;
  int8_t *triangle; /* 1: the node, this one and the next one of the star form a triangle */
  double *diagonal, *values;
} matrix;

/* A solution at the nodes of this rank, with its true and its estimated error. */
typedef struct {
  double nodes, error, estimate; /* over all ranks */
  double *u;                     /* [all] */
  double *density;               /* [all] estimated squared error per area around a node */
  double *area;                  /* [owned] this area: a third of the triangles of the star */
} solution;

static void check(pnpbs_status status, pnpbs_context context) {
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

/* ---------------------------------------------------------------- the known solution ----- */

/* Returns theta: 0 on the edge to the right of the re-entrant corner, growing counter-clockwise to
 * 3/2 pi on the edge below it. */
static double angle(const double *x) {
  const double theta = atan2(x[1], x[0]);
  return theta < -PI / 4 ? theta + 2 * PI : theta;
}

static double known_solution(const double *x) {
  return pow(hypot(x[0], x[1]), 2.0 / 3) * sin(2.0 / 3 * angle(x));
}

static void known_gradient(const double *x, double *g) {
  const double size = 2.0 / 3 * pow(hypot(x[0], x[1]), -1.0 / 3), theta = angle(x);
  g[0] = -size * sin(theta / 3);
  g[1] = size * cos(theta / 3);
}

/* ---------------------------------------------------------------- from the library ------- */

static void get_mesh(pnpbs_placement p, pnpbs_context context, mesh *m) {
  int64_t ghosts;
  check(pnpbs_placement_count(p, &m->owned), context);
  check(pnpbs_placement_ghost_count(p, &ghosts), context);
  m->all = m->owned + ghosts;
  m->xy = room(2 * m->all, sizeof(double));
  m->spacing = room(m->all, sizeof(double));
  m->tags = room(m->all, sizeof(int32_t));
  check(pnpbs_placement_get_nodes(p, m->owned, m->xy, NULL, m->tags, m->spacing), context);
  check(pnpbs_placement_get_ghosts(p, ghosts, m->xy + 2 * m->owned, NULL, m->tags + m->owned,
                                   m->spacing + m->owned, NULL),
        context);
  check(pnpbs_placement_get_triangles(p, 0, &m->triangles, NULL), context);
  m->corners = room(3 * m->triangles, sizeof(int64_t));
  check(pnpbs_placement_get_triangles(p, m->triangles, &m->triangles, m->corners), context);
}

static void get_exchange(pnpbs_placement p, pnpbs_context context, exchange *e) {
  int64_t sends, receives;
  check(pnpbs_placement_exchange_sizes(p, &e->neighbours, &sends, &receives), context);
  e->ranks = room(e->neighbours, sizeof(int32_t));
  e->send_offsets = room(e->neighbours + 1, sizeof(int64_t));
  e->send_nodes = room(sends, sizeof(int64_t));
  e->receive_offsets = room(e->neighbours + 1, sizeof(int64_t));
  e->receive_nodes = room(receives, sizeof(int64_t));
  check(pnpbs_placement_get_exchange(p, e->neighbours, sends, receives, e->ranks, e->send_offsets,
                                     e->send_nodes, e->receive_offsets, e->receive_nodes),
        context);
  e->sent = room(sends, sizeof(double));
  e->received = room(receives, sizeof(double));
  e->requests = room(2 * e->neighbours, sizeof(MPI_Request));
}

/* Returns the cotangent of the angle at a in the counter-clockwise triangle a, b, c. */
static double cotangent(const double *a, const double *b, const double *c) {
  const double bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1];
  return (bx * cx + by * cy) / (bx * cy - by * cx);
}

/* Returns the entry of the node that follows entry k in the star of node i, cyclically. */
static int64_t next_in_star(const matrix *a, int64_t i, int64_t k) {
  return k + 1 < a->offsets[i + 1] ? k + 1 : a->offsets[i];
}

/* Assembles the rows of the owned nodes from their Delaunay stars. For linear elements the integral
 * of grad phi_i . grad phi_j over a triangle is -1/2 times the cotangent of the angle opposite to
 * the edge ij, and every row sums to zero. Collective. */
static void assemble(pnpbs_placement p, pnpbs_context context, const mesh *m, matrix *a) {
  int64_t entries, i, k;
  check(pnpbs_placement_star_size(p, &entries), context);
  a->offsets = room(m->owned + 1, sizeof(int64_t));
  a->columns = room(entries, sizeof(int64_t));
  a->triangle = room(entries, sizeof(int8_t));
  a->diagonal = room(m->owned, sizeof(double));
  a->values = room(entries, sizeof(double));
  check(pnpbs_placement_get_stars(p, entries, a->offsets, a->columns, a->triangle), context);
  for (i = 0; i < m->owned; ++i)
    for (k = a->offsets[i]; k < a->offsets[i + 1]; ++k) {
      const int64_t next = next_in_star(a, i, k);
      const double *xi = m->xy + 2 * i;
      const double *xk = m->xy + 2 * a->columns[k], *xn = m->xy + 2 * a->columns[next];
      if (!a->triangle[k]) continue;
      a->values[k] -= cotangent(xn, xi, xk) / 2;
      a->values[next] -= cotangent(xk, xn, xi) / 2;
      a->diagonal[i] += (cotangent(xn, xi, xk) + cotangent(xk, xn, xi)) / 2;
    }
}

static void release(mesh *m, exchange *e, matrix *a, solution *s) {
  void *all[] = {m->xy,
                 m->spacing,
                 m->tags,
                 m->corners,
                 e->ranks,
                 e->send_offsets,
                 e->send_nodes,
                 e->receive_offsets,
                 e->receive_nodes,
                 e->sent,
                 e->received,
                 e->requests,
                 a->offsets,
                 a->columns,
                 a->triangle,
                 a->diagonal,
                 a->values,
                 s->u,
                 s->density,
                 s->area};
  size_t i;
  for (i = 0; i < sizeof all / sizeof *all; ++i) free(all[i]);
}

/* ---------------------------------------------------------------- the solver ------------- */

static double sum_over_ranks(const mesh *m, double part) {
  double sum;
  MPI_Allreduce(&part, &sum, 1, MPI_DOUBLE, MPI_SUM, m->comm);
  return sum;
}

static double dot(const mesh *m, const double *x, const double *y) {
  double part = 0;
  int64_t i;
  for (i = 0; i < m->owned; ++i) part += x[i] * y[i];
  return sum_over_ranks(m, part);
}

/* Copies the values at nodes to their ghosts on other ranks. Collective. */
static void update_ghosts(const mesh *m, const exchange *e, double *x) {
  const int64_t *s = e->send_offsets, *r = e->receive_offsets;
  int64_t i;
  int32_t k;
  for (k = 0; k < e->neighbours; ++k)
    MPI_Irecv(e->received + r[k], (int)(r[k + 1] - r[k]), MPI_DOUBLE, e->ranks[k], 0, m->comm,
              &e->requests[k]);
  for (i = 0; i < s[e->neighbours]; ++i) e->sent[i] = x[e->send_nodes[i]];
  for (k = 0; k < e->neighbours; ++k)
    MPI_Isend(e->sent + s[k], (int)(s[k + 1] - s[k]), MPI_DOUBLE, e->ranks[k], 0, m->comm,
              &e->requests[e->neighbours + k]);
  MPI_Waitall(2 * e->neighbours, e->requests, MPI_STATUSES_IGNORE);
  for (i = 0; i < r[e->neighbours]; ++i) x[e->receive_nodes[i]] = e->received[i];
}

/* Computes y = A x at the owned nodes. Updates the ghosts of x first. Collective. */
static void multiply(const mesh *m, const exchange *e, const matrix *a, double *x, double *y) {
  int64_t i, k;
  update_ghosts(m, e, x);
  for (i = 0; i < m->owned; ++i) {
    y[i] = a->diagonal[i] * x[i];
    for (k = a->offsets[i]; k < a->offsets[i + 1]; ++k) y[i] += a->values[k] * x[a->columns[k]];
  }
}

/* Solves A u = 0 at the inner nodes by conjugate gradients with the diagonal as preconditioner.
 * Values of u on the boundary do not change, because the residual is set to zero there. Collective.
 */
static void solve(const mesh *m, const exchange *e, const matrix *a, double *u) {
  double *r = room(m->owned, sizeof(double)), *q = room(m->owned, sizeof(double));
  double *z = room(m->owned, sizeof(double)), *p = room(m->all, sizeof(double));
  double rz, rz_before, enough, alpha;
  int64_t i;
  int steps = 0;
  multiply(m, e, a, u, q);
  for (i = 0; i < m->owned; ++i) r[i] = m->tags[i] != 0 ? 0 : -q[i];
  for (i = 0; i < m->owned; ++i) p[i] = z[i] = r[i] / a->diagonal[i];
  rz = dot(m, r, z);
  enough = 1e-26 * rz;
  while (rz > enough) {
    if (++steps > 10000) {
      fprintf(stderr, "conjugate gradients do not converge\n");
      MPI_Abort(m->comm, 1);
    }
    multiply(m, e, a, p, q);
    alpha = rz / dot(m, p, q);
    for (i = 0; i < m->owned; ++i) u[i] += alpha * p[i];
    for (i = 0; i < m->owned; ++i) r[i] = m->tags[i] != 0 ? 0 : r[i] - alpha * q[i];
    for (i = 0; i < m->owned; ++i) z[i] = r[i] / a->diagonal[i];
    rz_before = rz;
    rz = dot(m, r, z);
    for (i = 0; i < m->owned; ++i) p[i] = z[i] + rz / rz_before * p[i];
  }
  update_ghosts(m, e, u);
  free(r);
  free(q);
  free(z);
  free(p);
}

/* ---------------------------------------------------------------- the error -------------- */

/* Computes the constant gradient of u on a triangle and returns the area. */
static double gradient(const mesh *m, const double *u, int64_t i, int64_t j, int64_t k, double *g) {
  const double *xi = m->xy + 2 * i, *xj = m->xy + 2 * j, *xk = m->xy + 2 * k;
  const double jx = xj[0] - xi[0], jy = xj[1] - xi[1], kx = xk[0] - xi[0], ky = xk[1] - xi[1];
  const double twice = jx * ky - jy * kx;
  g[0] = ((u[j] - u[i]) * ky - (u[k] - u[i]) * jy) / twice;
  g[1] = ((u[k] - u[i]) * jx - (u[j] - u[i]) * kx) / twice;
  return twice / 2;
}

/* Computes the mean gradient of u over the triangles of each star, weighted by their areas.
 * Collective. */
static void average_gradients(const mesh *m, const exchange *e, const matrix *a, const double *u,
                              double *gx, double *gy) {
  int64_t i, k;
  for (i = 0; i < m->owned; ++i) {
    double total = 0, g[2];
    for (k = a->offsets[i]; k < a->offsets[i + 1]; ++k)
      if (a->triangle[k]) {
        const double area = gradient(m, u, i, a->columns[k], a->columns[next_in_star(a, i, k)], g);
        gx[i] += area * g[0];
        gy[i] += area * g[1];
        total += area;
      }
    gx[i] /= total;
    gy[i] /= total;
  }
  update_ghosts(m, e, gx);
  update_ghosts(m, e, gy);
}

/* Returns the integral of the square of a linear function over a triangle from its values a, b and
 * c at the corners. */
static double integral_of_square(double area, double a, double b, double c) {
  return area / 12 * (a * a + b * b + c * c + (a + b + c) * (a + b + c));
}

/* Estimates the squared error around each node, a third of that on the triangles of its star.
 * Collective. */
static void estimate(const mesh *m, const exchange *e, const matrix *a, solution *s) {
  double *gx = room(m->all, sizeof(double)), *gy = room(m->all, sizeof(double)), all = 0;
  int64_t i, k;
  average_gradients(m, e, a, s->u, gx, gy);
  for (i = 0; i < m->owned; ++i) {
    double part = 0, g[2];
    for (k = a->offsets[i]; k < a->offsets[i + 1]; ++k)
      if (a->triangle[k]) {
        const int64_t j = a->columns[k], l = a->columns[next_in_star(a, i, k)];
        const double area = gradient(m, s->u, i, j, l, g);
        part += integral_of_square(area, gx[i] - g[0], gx[j] - g[0], gx[l] - g[0]) / 3;
        part += integral_of_square(area, gy[i] - g[1], gy[j] - g[1], gy[l] - g[1]) / 3;
        s->area[i] += area / 3;
      }
    s->density[i] = part / s->area[i];
    all += part;
  }
  s->estimate = sqrt(sum_over_ranks(m, all));
  free(gx);
  free(gy);
}

/* Returns the integral of |grad u - g|^2 over a triangle, where u is the known solution. A triangle
 * that is small compared with its distance from the re-entrant corner is integrated by the
 * midpoints of its edges. Others are divided into four, at most 14 times; the rest of the
 * singularity is negligible then. */
static double squared_error(const double *a, const double *b, const double *c, const double *g,
                            int depth) {
  const double ab[2] = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
  const double bc[2] = {(b[0] + c[0]) / 2, (b[1] + c[1]) / 2};
  const double ca[2] = {(c[0] + a[0]) / 2, (c[1] + a[1]) / 2};
  const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  const double *middles[3];
  double sum = 0, known[2];
  int i;
  if (depth < 14 && sqrt(twice) > 0.2 * hypot(bc[0], bc[1]))
    return squared_error(a, ab, ca, g, depth + 1) + squared_error(ab, b, bc, g, depth + 1) +
           squared_error(ca, bc, c, g, depth + 1) + squared_error(ab, bc, ca, g, depth + 1);
  middles[0] = ab, middles[1] = bc, middles[2] = ca;
  for (i = 0; i < 3; ++i) {
    known_gradient(middles[i], known);
    sum += pow(known[0] - g[0], 2) + pow(known[1] - g[1], 2);
  }
  return twice / 6 * sum;
}

/* Returns the true error in the energy norm. Collective. */
static double energy_error(const mesh *m, const double *u) {
  double part = 0, g[2];
  int64_t t;
  for (t = 0; t < m->triangles; ++t) {
    const int64_t *c = m->corners + 3 * t;
    gradient(m, u, c[0], c[1], c[2], g);
    part += squared_error(m->xy + 2 * c[0], m->xy + 2 * c[1], m->xy + 2 * c[2], g, 0);
  }
  return sqrt(sum_over_ranks(m, part));
}

/* ---------------------------------------------------------------- rounds ----------------- */

static void solve_and_estimate(pnpbs_placement p, pnpbs_context context, mesh *m, exchange *e,
                               matrix *a, solution *s) {
  int64_t i;
  get_mesh(p, context, m);
  get_exchange(p, context, e);
  assemble(p, context, m, a);
  s->u = room(m->all, sizeof(double));
  s->density = room(m->all, sizeof(double));
  s->area = room(m->owned, sizeof(double));
  for (i = 0; i < m->owned; ++i)
    if (m->tags[i] != 0) s->u[i] = known_solution(m->xy + 2 * i);
  solve(m, e, a, s->u);
  estimate(m, e, a, s);
  s->nodes = sum_over_ranks(m, (double)m->owned);
  s->error = energy_error(m, s->u);
}

/* Returns d rounded to six bits. The last bits of d depend on the order in which MPI sums over the
 * ranks, and nodes depend on all bits of d. Rounding makes the nodes independent of the number of
 * ranks. */
static double rounded(double d) {
  int exponent;
  const double fraction = frexp(d, &exponent);
  return ldexp(floor(64 * fraction + 0.5), exponent - 6);
}

/* Sets the spacing for which about `nodes` nodes share the error evenly. With spacing h and squared
 * error per area w, the quotient w / h^2 does not depend on h, because it is about |second
 * derivatives|^2. A node with the new spacing d has the squared error w / h^2 d^4 around it; d
 * equalises this error over all nodes. Equilateral triangles with edges of length d have 2 /
 * sqrt(3) nodes per d^2. One step changes d by factors between 1/8 and 1.5. Collective. */
static void adapt(pnpbs_placement p, pnpbs_context context, const mesh *m, const solution *s,
                  double nodes) {
  double *d = room(m->owned, sizeof(double)), part = 0, scale;
  int64_t i;
  for (i = 0; i < m->owned; ++i) part += s->area[i] * sqrt(s->density[i]) / m->spacing[i];
  scale = 2 / sqrt(3.0) * sum_over_ranks(m, part) / nodes;
  for (i = 0; i < m->owned; ++i) {
    const double h = m->spacing[i], wanted = sqrt(scale * h / sqrt(s->density[i]));
    d[i] = rounded(fmin(fmax(wanted, h / 8), 1.5 * h));
  }
  check(pnpbs_placement_set_spacing_at_nodes(p, m->owned, d), context);
  free(d);
}

/* Repartitions the work if the largest work of a rank exceeds the mean by 5 % or more. The nodes do
 * not change. Collective. */
static void balance(pnpbs_placement p, pnpbs_context context, int rank) {
  double before, after;
  check(pnpbs_placement_get_double(p, "imbalance", &before), context);
  if (before < 1.05) return;
  check(pnpbs_placement_rebalance(p), context);
  check(pnpbs_placement_get_double(p, "imbalance", &after), context);
  if (rank == 0) printf("  largest work over mean: %.2f, partitioned anew: %.2f\n", before, after);
}

static double least_spacing(const mesh *m) {
  double part = 2, least;
  int64_t i;
  for (i = 0; i < m->owned; ++i) part = fmin(part, m->spacing[i]);
  MPI_Allreduce(&part, &least, 1, MPI_DOUBLE, MPI_MIN, m->comm);
  return least;
}

static void print_round(const char *kind, int round, const mesh *m, const solution *s) {
  const double least = least_spacing(m);
  int rank;
  MPI_Comm_rank(m->comm, &rank);
  if (rank == 0)
    printf("%s, round %d: %.0f nodes, least d %.6f, error %.5f, estimate over error %.3f\n", kind,
           round, s->nodes, least, s->error, s->estimate / s->error);
}

/* Writes FOLDER/adaptive_corner_<rank>.vtk for examples/draw_pieces.py or ParaView. The field
 * `estimate` is the root of the estimated squared error per area. */
static void write_piece(const char *folder, const mesh *m, const exchange *e, const solution *s) {
  const long all = (long)m->all, triangles = (long)m->triangles;
  const int64_t *c = m->corners;
  char path[1024];
  long i;
  int rank;
  FILE *file;
  MPI_Comm_rank(m->comm, &rank);
  snprintf(path, sizeof path, "%s/adaptive_corner_%03d.vtk", folder, rank);
  file = fopen(path, "w");
  if (file == NULL) {
    fprintf(stderr, "cannot write %s\n", path);
    MPI_Abort(MPI_COMM_WORLD, 1);
    return;
  }
  fprintf(file, "# vtk DataFile Version 3.0\nadaptive_corner\nASCII\nDATASET UNSTRUCTURED_GRID\n");
  fprintf(file, "POINTS %ld double\n", all);
  for (i = 0; i < all; ++i) fprintf(file, "%.9g %.9g 0\n", m->xy[2 * i], m->xy[2 * i + 1]);
  fprintf(file, "CELLS %ld %ld\n", triangles, 4 * triangles);
  for (i = 0; i < triangles; ++i, c += 3)
    fprintf(file, "3 %ld %ld %ld\n", (long)c[0], (long)c[1], (long)c[2]);
  fprintf(file, "CELL_TYPES %ld\n", triangles);
  for (i = 0; i < triangles; ++i) fprintf(file, "5\n");
  fprintf(file, "POINT_DATA %ld\nSCALARS solution double\nLOOKUP_TABLE default\n", all);
  for (i = 0; i < all; ++i) fprintf(file, "%.9g\n", s->u[i]);
  fprintf(file, "SCALARS error double\nLOOKUP_TABLE default\n");
  for (i = 0; i < all; ++i) fprintf(file, "%.9g\n", fabs(s->u[i] - known_solution(m->xy + 2 * i)));
  fprintf(file, "SCALARS spacing double\nLOOKUP_TABLE default\n");
  for (i = 0; i < all; ++i) fprintf(file, "%.9g\n", m->spacing[i]);
  update_ghosts(m, e, s->density);
  fprintf(file, "SCALARS estimate double\nLOOKUP_TABLE default\n");
  for (i = 0; i < all; ++i) fprintf(file, "%.9g\n", sqrt(s->density[i]));
  fclose(file);
}

/* Numbers of nodes and errors of all rounds. `effectivity` is the estimate over the true error in
 * the last round. */
typedef struct {
  double nodes[ROUNDS], errors[ROUNDS], effectivity;
} history;

static void remember(history *h, int round, const solution *s) {
  h->nodes[round] = s->nodes;
  h->errors[round] = s->error;
  h->effectivity = s->estimate / s->error;
}

/* Returns the constant spacing that results in about `nodes` nodes in the L: 2 / sqrt(3) nodes per
 * d^2 of the area plus half a node per d of the boundary. */
static double uniform_spacing(double nodes) {
  const double a = 2 / sqrt(3.0) * AREA, b = PERIMETER / 2;
  return 2 * a / (sqrt(b * b + 4 * a * nodes) - b);
}

static void adapted_rounds(MPI_Comm comm, pnpbs_context context, pnpbs_domain domain,
                           const char *folder, history *h) {
  pnpbs_placement p;
  int round, rank;
  MPI_Comm_rank(comm, &rank);
  check(pnpbs_placement_create(context, domain, &p), context);
  /* The growth limit smooths the jumps of the estimate. The high threshold switches off the
   * library's own repartitioning, because this program calls pnpbs_placement_rebalance. */
  check(pnpbs_placement_set_double(p, "growth_limit", 0.4), context);
  check(pnpbs_placement_set_double(p, "rebalance_above", 1e6), context);
  check(pnpbs_placement_set_spacing_constant(p, uniform_spacing(FIRST_NODES)), context);
  for (round = 0; round < ROUNDS; ++round) {
    mesh m;
    exchange e;
    matrix a;
    solution s;
    m.comm = comm;
    check(pnpbs_placement_run(p), context);
    balance(p, context, rank);
    solve_and_estimate(p, context, &m, &e, &a, &s);
    print_round("adapted", round, &m, &s);
    remember(h, round, &s);
    if (round < ROUNDS - 1)
      adapt(p, context, &m, &s, FIRST_NODES * pow(2, round + 1));
    else if (folder != NULL)
      write_piece(folder, &m, &e, &s);
    release(&m, &e, &a, &s);
  }
  pnpbs_placement_destroy(&p);
}

/* Repeats the rounds with a constant d and about as many nodes. */
static void uniform_rounds(MPI_Comm comm, pnpbs_context context, pnpbs_domain domain,
                           const double *nodes, history *h) {
  int round;
  for (round = 0; round < ROUNDS; ++round) {
    pnpbs_placement p;
    mesh m;
    exchange e;
    matrix a;
    solution s;
    m.comm = comm;
    check(pnpbs_placement_create(context, domain, &p), context);
    check(pnpbs_placement_set_spacing_constant(p, uniform_spacing(nodes[round])), context);
    check(pnpbs_placement_run(p), context);
    solve_and_estimate(p, context, &m, &e, &a, &s);
    print_round("uniform", round, &m, &s);
    remember(h, round, &s);
    release(&m, &e, &a, &s);
    pnpbs_placement_destroy(&p);
  }
}

/* Returns the order of convergence p in error ~ N^(-p): minus the slope of log(error) over log(N),
 * fitted by least squares to the last four rounds. */
static double order(const history *h) {
  double x = 0, y = 0, xx = 0, xy = 0;
  const int n = 4;
  int i;
  for (i = ROUNDS - n; i < ROUNDS; ++i) {
    x += log(h->nodes[i]) / n;
    y += log(h->errors[i]) / n;
  }
  for (i = ROUNDS - n; i < ROUNDS; ++i) {
    xx += (log(h->nodes[i]) - x) * (log(h->nodes[i]) - x);
    xy += (log(h->nodes[i]) - x) * (log(h->errors[i]) - y);
  }
  return -xy / xx;
}

int main(int argc, char **argv) {
  const double corners[6][2] = {{0, 0}, {1, 0}, {1, 1}, {-1, 1}, {-1, -1}, {0, -1}};
  const MPI_Comm comm = MPI_COMM_WORLD; /* or any other communicator */
  pnpbs_context context;
  pnpbs_domain domain;
  history adapted, uniform;
  int rank;

  MPI_Init(&argc, &argv);
  MPI_Comm_rank(comm, &rank);
  check(pnpbs_context_create_mpi(comm, &context), NULL);
  check(pnpbs_domain_create(context, 2, &domain), context);
  check(pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 6, &corners[0][0], NULL, 0), context);
  adapted_rounds(comm, context, domain, argc > 1 ? argv[1] : NULL, &adapted);
  uniform_rounds(comm, context, domain, adapted.nodes, &uniform);
  if (rank == 0) {
    const int last = ROUNDS - 1;
    printf("nodes: %.0f, expected at least 10000\n", adapted.nodes[last]);
    printf("order of the error when adapted: %.3f, expected at least 0.48\n", order(&adapted));
    printf("order of the error when uniform: %.3f, expected at most 0.36\n", order(&uniform));
    printf("error when uniform over that when adapted: %.2f, expected at least 4\n",
           uniform.errors[last] / adapted.errors[last]);
    printf("estimate over error, adapted: %.3f, expected about 1\n", adapted.effectivity);
  }
  pnpbs_domain_destroy(&domain);
  pnpbs_context_destroy(&context);
  MPI_Finalize();
  return 0;
}
