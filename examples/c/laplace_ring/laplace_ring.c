/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A finite element solver on the library's nodes, over the ranks of an MPI program. It solves
 * -Laplace u = 0 in the ring 0.5 <= r <= 1 with u = log r on both circles; the solution is log r
 * everywhere. The row of a node follows from the triangles of its Delaunay star alone, so every
 * rank assembles the rows of its own nodes without a mesh file and without messages.
 * examples/fortran/laplace_ring is the same program in Fortran.
 *
 *   mpirun -np 4 ./laplace_ring [FOLDER]
 *
 * If a folder is given, every rank writes its piece of the solution into it; the folder must exist.
 *
 * Results to check:
 *   nodes      Equilateral triangles with edges of length d have 2 / (sqrt(3) d^2) nodes per area.
 *              Each boundary node adds half a node.
 *   triangles  n nodes, b of them on the two circles, form 2 n - b triangles.
 *   flux       The flux through the outer circle is 2 pi.
 *   error      Second derivatives of log r are at most 1 / 0.5^2, so linear interpolation on
 *              equilateral triangles has an error of at most d^2 / 6 * 4. The solution should not
 *              have a larger one.
 */
#include <math.h>
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>
#include <stdio.h>
#include <stdlib.h>

#define PI 3.14159265358979323846
static const double inner_radius = 0.5, outer_radius = 1, d = 0.03;
enum { INNER_CIRCLE = 1, OUTER_CIRCLE = 2 };

/* The mesh of this rank. Arrays over `all` hold the owned nodes first, then the ghosts, which are
 * nearby nodes that other ranks own. */
typedef struct {
  MPI_Comm comm;
  int64_t owned, all;          /* all = owned + ghosts */
  double *xy;                  /* [all][2] */
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
  double *diagonal, *values;
} matrix;

static double known_solution(const double *x) { return log(hypot(x[0], x[1])); }

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

/* ---------------------------------------------------------------- from the library ------- */

static void get_mesh(pnpbs_placement p, pnpbs_context context, mesh *m) {
  int64_t ghosts;
  check(pnpbs_placement_count(p, &m->owned), context);
  check(pnpbs_placement_ghost_count(p, &ghosts), context);
  m->all = m->owned + ghosts;
  m->xy = room(2 * m->all, sizeof(double));
  m->tags = room(m->all, sizeof(int32_t));
  check(pnpbs_placement_get_nodes(p, m->owned, m->xy, NULL, m->tags, NULL), context);
  check(pnpbs_placement_get_ghosts(p, ghosts, m->xy + 2 * m->owned, NULL, m->tags + m->owned, NULL,
                                   NULL),
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

/* Assembles the rows of the owned nodes from their Delaunay stars. For linear elements the integral
 * of grad phi_i . grad phi_j over a triangle is -1/2 times the cotangent of the angle opposite to
 * the edge ij, and every row sums to zero. Collective. */
static void assemble(pnpbs_placement p, pnpbs_context context, const mesh *m, matrix *a) {
  int64_t entries, i, k;
  int8_t *triangle;
  check(pnpbs_placement_star_size(p, &entries), context);
  a->offsets = room(m->owned + 1, sizeof(int64_t));
  a->columns = room(entries, sizeof(int64_t));
  a->diagonal = room(m->owned, sizeof(double));
  a->values = room(entries, sizeof(double));
  triangle = room(entries, sizeof(int8_t));
  check(pnpbs_placement_get_stars(p, entries, a->offsets, a->columns, triangle), context);
  for (i = 0; i < m->owned; ++i)
    for (k = a->offsets[i]; k < a->offsets[i + 1]; ++k) {
      const int64_t next = k + 1 < a->offsets[i + 1] ? k + 1 : a->offsets[i];
      const double *xi = m->xy + 2 * i;
      const double *xk = m->xy + 2 * a->columns[k], *xn = m->xy + 2 * a->columns[next];
      if (!triangle[k]) continue; /* a gap outside the domain */
      a->values[k] -= cotangent(xn, xi, xk) / 2;
      a->values[next] -= cotangent(xk, xn, xi) / 2;
      a->diagonal[i] += (cotangent(xn, xi, xk) + cotangent(xk, xn, xi)) / 2;
    }
  free(triangle);
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

/* Solves A u = 0 at the inner nodes by conjugate gradients. Values of u on the boundary do not
 * change, because the residual is set to zero there. Collective. */
static void solve(const mesh *m, const exchange *e, const matrix *a, double *u) {
  double *r = room(m->owned, sizeof(double)), *q = room(m->owned, sizeof(double));
  double *p = room(m->all, sizeof(double)), rr, rr_before, enough, alpha;
  int64_t i;
  int steps = 0;
  multiply(m, e, a, u, q);
  for (i = 0; i < m->owned; ++i) p[i] = r[i] = m->tags[i] != 0 ? 0 : -q[i];
  rr = dot(m, r, r);
  enough = 1e-20 * rr;
  while (rr > enough) {
    if (++steps > 10000) {
      fprintf(stderr, "conjugate gradients do not converge\n");
      MPI_Abort(m->comm, 1);
    }
    multiply(m, e, a, p, q);
    alpha = rr / dot(m, p, q);
    for (i = 0; i < m->owned; ++i) u[i] += alpha * p[i];
    for (i = 0; i < m->owned; ++i) r[i] = m->tags[i] != 0 ? 0 : r[i] - alpha * q[i];
    rr_before = rr;
    rr = dot(m, r, r);
    for (i = 0; i < m->owned; ++i) p[i] = r[i] + rr / rr_before * p[i];
  }
  update_ghosts(m, e, u);
  free(r);
  free(q);
  free(p);
}

/* ---------------------------------------------------------------- the results ------------ */

static double largest_error(const mesh *m, const double *u) {
  double part = 0, largest;
  int64_t i;
  for (i = 0; i < m->owned; ++i) part = fmax(part, fabs(u[i] - known_solution(m->xy + 2 * i)));
  MPI_Allreduce(&part, &largest, 1, MPI_DOUBLE, MPI_MAX, m->comm);
  return largest;
}

/* Returns the root of the integral of (u - log r)^2, computed with the midpoints of the edges of
 * each triangle. Collective. */
static double l2_error(const mesh *m, const double *u) {
  double part = 0;
  int64_t t;
  int i;
  for (t = 0; t < m->triangles; ++t) {
    const int64_t *c = m->corners + 3 * t;
    const double *x = m->xy + 2 * c[0], *y = m->xy + 2 * c[1], *z = m->xy + 2 * c[2];
    const double area = ((y[0] - x[0]) * (z[1] - x[1]) - (y[1] - x[1]) * (z[0] - x[0])) / 2;
    for (i = 0; i < 3; ++i) {
      const double *a = m->xy + 2 * c[i], *b = m->xy + 2 * c[(i + 1) % 3];
      const double middle[2] = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
      const double error = (u[c[i]] + u[c[(i + 1) % 3]]) / 2 - known_solution(middle);
      part += area / 3 * error * error;
    }
  }
  return sqrt(sum_over_ranks(m, part));
}

/* Returns the integral of the normal derivative of u over the outer circle, which is the sum of A u
 * over the nodes there. Collective. */
static double outer_flux(const mesh *m, const exchange *e, const matrix *a, double *u) {
  double *q = room(m->owned, sizeof(double)), part = 0;
  int64_t i;
  multiply(m, e, a, u, q);
  for (i = 0; i < m->owned; ++i)
    if (m->tags[i] == OUTER_CIRCLE) part += q[i];
  free(q);
  return sum_over_ranks(m, part);
}

static void print_results(const mesh *m, const exchange *e, const matrix *a, double *u) {
  const double area = PI * (outer_radius * outer_radius - inner_radius * inner_radius);
  const double bound = d * d / 6 / (inner_radius * inner_radius);
  const double nodes = sum_over_ranks(m, (double)m->owned);
  const double triangles = sum_over_ranks(m, (double)m->triangles);
  const double flux = outer_flux(m, e, a, u);
  const double largest = largest_error(m, u), l2 = l2_error(m, u);
  double boundary = 0;
  int64_t i;
  int rank;
  for (i = 0; i < m->owned; ++i) boundary += m->tags[i] != 0;
  boundary = sum_over_ranks(m, boundary);
  MPI_Comm_rank(m->comm, &rank);
  if (rank != 0) return;
  printf("nodes: %.0f, expected about %.0f\n", nodes, 2 * area / sqrt(3) / (d * d) + boundary / 2);
  printf("triangles: %.0f, expected %.0f\n", triangles, 2 * nodes - boundary);
  printf("flux through the outer circle: %.5f, expected about %.5f\n", flux, 2 * PI);
  printf("largest error: %.8f, expected at most %.8f\n", largest, bound);
  printf("L2 error: %.8f, expected at most %.8f\n", l2, bound * sqrt(area));
}

/* Writes FOLDER/laplace_ring_<rank>.vtk for examples/draw_pieces.py or ParaView. */
static void write_piece(const char *folder, const mesh *m, const double *u) {
  const long all = (long)m->all, triangles = (long)m->triangles;
  const int64_t *c = m->corners;
  char path[1024];
  long i;
  int rank;
  FILE *file;
  MPI_Comm_rank(m->comm, &rank);
  snprintf(path, sizeof path, "%s/laplace_ring_%03d.vtk", folder, rank);
  file = fopen(path, "w");
  if (file == NULL) {
    fprintf(stderr, "cannot write %s\n", path);
    MPI_Abort(MPI_COMM_WORLD, 1);
    return;
  }
  fprintf(file, "# vtk DataFile Version 3.0\nlaplace_ring\nASCII\nDATASET UNSTRUCTURED_GRID\n");
  fprintf(file, "POINTS %ld double\n", all);
  for (i = 0; i < all; ++i) fprintf(file, "%.9g %.9g 0\n", m->xy[2 * i], m->xy[2 * i + 1]);
  fprintf(file, "CELLS %ld %ld\n", triangles, 4 * triangles);
  for (i = 0; i < triangles; ++i, c += 3)
    fprintf(file, "3 %ld %ld %ld\n", (long)c[0], (long)c[1], (long)c[2]);
  fprintf(file, "CELL_TYPES %ld\n", triangles);
  for (i = 0; i < triangles; ++i) fprintf(file, "5\n");
  fprintf(file, "POINT_DATA %ld\nSCALARS solution double\nLOOKUP_TABLE default\n", all);
  for (i = 0; i < all; ++i) fprintf(file, "%.9g\n", u[i]);
  fprintf(file, "SCALARS error double\nLOOKUP_TABLE default\n");
  for (i = 0; i < all; ++i) fprintf(file, "%.9g\n", fabs(u[i] - known_solution(m->xy + 2 * i)));
  fclose(file);
}

/* ---------------------------------------------------------------- the program ------------ */

static void release(mesh *m, exchange *e, matrix *a) {
  void *all[] = {m->xy,           m->tags,       m->corners,         e->ranks,
                 e->send_offsets, e->send_nodes, e->receive_offsets, e->receive_nodes,
                 e->sent,         e->received,   e->requests,        a->offsets,
                 a->columns,      a->diagonal,   a->values};
  size_t i;
  for (i = 0; i < sizeof all / sizeof *all; ++i) free(all[i]);
}

int main(int argc, char **argv) {
  const double centre[2] = {0, 0};
  pnpbs_context context;
  pnpbs_domain domain;
  pnpbs_placement placement;
  mesh m;
  exchange e;
  matrix a;
  double *u;
  int64_t i;

  MPI_Init(&argc, &argv);
  m.comm = MPI_COMM_WORLD; /* or any other communicator */
  check(pnpbs_context_create_mpi(m.comm, &context), NULL);
  check(pnpbs_domain_create(context, 2, &domain), context);
  check(pnpbs_domain_add_arc(domain, PNPBS_BOUNDARY, centre, inner_radius, 0, 2 * PI, INNER_CIRCLE),
        context);
  check(pnpbs_domain_add_arc(domain, PNPBS_BOUNDARY, centre, outer_radius, 0, 2 * PI, OUTER_CIRCLE),
        context);
  check(pnpbs_placement_create(context, domain, &placement), context);
  check(pnpbs_placement_set_spacing_constant(placement, d), context);
  check(pnpbs_placement_run(placement), context);

  get_mesh(placement, context, &m);
  get_exchange(placement, context, &e);
  assemble(placement, context, &m, &a);
  u = room(m.all, sizeof(double));
  for (i = 0; i < m.owned; ++i)
    if (m.tags[i] != 0) u[i] = known_solution(m.xy + 2 * i);
  solve(&m, &e, &a, u);
  print_results(&m, &e, &a, u);
  if (argc > 1) write_piece(argv[1], &m, u);

  free(u);
  release(&m, &e, &a);
  pnpbs_placement_destroy(&placement);
  pnpbs_domain_destroy(&domain);
  pnpbs_context_destroy(&context);
  MPI_Finalize();
  return 0;
}
