/* SPDX-License-Identifier: BSD-3-Clause
 *
 * An adaptive loop in space, over the ranks of an MPI program. Each round solves, estimates the
 * error, changes the spacing d and places the nodes again. The body is an L-block, which is a plate
 * of 2 by 2 by 1 without one quarter. The problem -Laplace u = 0 has the solution
 * u = r^(2/3) sin(2 theta / 3), where r and theta are polar coordinates about the re-entrant edge.
 * Its gradient is infinite at this edge. The program uses linear finite elements on the tetrahedra
 * and conjugate gradients.
 *
 *   mpirun -np 4 ./adaptive_block [ROUNDS [FOLDER]]
 *
 * Each tetrahedron belongs to one rank, and its corners may be ghosts. Every sum over tetrahedra is
 * therefore computed in two steps: each rank adds the contributions of its tetrahedra to nodes and
 * ghosts, then the sums at ghosts are sent to the owners and added there (add_ghosts). Values at
 * nodes are sent in the opposite direction (update_ghosts). No rank holds all nodes. If a folder is
 * given, every rank writes its piece of the last round into it; the folder must exist.
 *
 * Results to check, for linear elements and the energy norm, which is the root of the integral of
 * |grad error|^2: with N nodes and constant d the error falls as N^(-2/9) because of the edge. On
 * adapted nodes it falls as N^(-1/3), the rate of a smooth solution.
 */
#include <math.h>
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>
#include <stdio.h>
#include <stdlib.h>

#define ROUNDS 5 /* default of the first argument */
#define MOST_ROUNDS 9
#define FIRST_NODES 400.0 /* nodes of round 0; each round doubles the number */
#define PI 3.14159265358979323846
#define VOLUME 3.0
#define NODES_PER_CUBE 1.55 /* nodes per d^3 */
/* Barycentric coordinates of the four-point quadrature rule on a tetrahedron, which is exact for
 * polynomials of second degree: NEAR belongs to the corner next to the point, FAR to the others. */
#define NEAR 0.58541019662496845
#define FAR 0.13819660112501051

/* The mesh of this rank. Arrays over `all` hold the owned nodes first, then the ghosts, which are
 * nearby nodes that other ranks own. */
typedef struct {
  MPI_Comm comm;
  int64_t owned, all;           /* all = owned + ghosts */
  double *x;                    /* [all][3] */
  double *spacing;              /* [owned] */
  int32_t *tags;                /* [owned] */
  int64_t tetrahedra, *corners; /* [tetrahedra][4] */
} mesh;

/* One side of the halo exchange, either the sent or the received nodes. The nodes that are
 * exchanged with neighbour k are nodes[offsets[k]] .. nodes[offsets[k + 1] - 1]; `values` is the
 * message buffer. */
typedef struct {
  int64_t *offsets, *nodes;
  double *values;
} side;

typedef struct {
  int32_t neighbours, *ranks;
  side shared; /* owned nodes that are ghosts on other ranks */
  side ghosts; /* ghosts on this rank */
  MPI_Request *requests;
} exchange;

/* A solution at the nodes of this rank, with its true and its estimated error. */
typedef struct {
  double nodes, error, estimate; /* over all ranks */
  double *u;                     /* [all] */
  double *density;               /* [all] estimated squared error per volume around a node */
  double *volume;                /* [all] this volume: a quarter of the tetrahedra at a node */
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

/* ---------------------------------------------------------------- the body --------------- */

/* Adds the surface of the L-block to the domain. Vertices as seen from above, with the re-entrant
 * edge at vertex 3, which is (1, 1); vertices 6 .. 11 lie above them at z = 1:
 *   5---4
 *   |   |
 *   |   3---2
 *   0-------1 */
static void add_block(pnpbs_domain domain, pnpbs_context context) {
  const double outline[6][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  const int64_t cover[4][3] = {{3, 4, 5}, {3, 5, 0}, {3, 0, 1}, {3, 1, 2}};
  double vertices[12][3];
  int64_t triangles[20][3];
  int i, k;
  for (i = 0; i < 12; ++i) {
    vertices[i][0] = outline[i % 6][0];
    vertices[i][1] = outline[i % 6][1];
    vertices[i][2] = i / 6;
  }
  for (i = 0; i < 4; ++i)
    for (k = 0; k < 3; ++k) {
      triangles[i][k] = cover[i][2 - k]; /* bottom, counter-clockwise as seen from below */
      triangles[4 + i][k] = cover[i][k] + 6;
    }
  for (i = 0; i < 6; ++i) {
    const int64_t a = i, b = (i + 1) % 6;
    int64_t *t = triangles[8 + 2 * i];
    t[0] = a, t[1] = b, t[2] = b + 6;
    t[3] = a, t[4] = b + 6, t[5] = a + 6;
  }
  check(pnpbs_domain_add_surface(domain, PNPBS_BOUNDARY, 12, &vertices[0][0], 20, &triangles[0][0],
                                 NULL, 40),
        context);
}

/* ---------------------------------------------------------------- the known solution ----- */

static double distance(const double *x) { return hypot(x[0] - 1, x[1] - 1); }

/* Returns theta: 0 on the face above the re-entrant edge (direction +y), growing counter-clockwise
 * to 3/2 pi on the face to its right. */
static double angle(const double *x) {
  const double theta = atan2(1 - x[0], x[1] - 1);
  return theta < -PI / 4 ? theta + 2 * PI : theta;
}

static double known_solution(const double *x) {
  return pow(distance(x), 2.0 / 3) * sin(2.0 / 3 * angle(x));
}

/* Computes grad u. The axes of r and theta are y, where theta is 0, and -x; u does not depend on z.
 */
static void known_gradient(const double *x, double *g) {
  const double size = 2.0 / 3 / cbrt(distance(x)), theta = angle(x);
  g[0] = -size * cos(theta / 3);
  g[1] = -size * sin(theta / 3);
  g[2] = 0;
}

/* ---------------------------------------------------------------- from the library ------- */

static void get_mesh(pnpbs_placement p, pnpbs_context context, mesh *m) {
  int64_t ghosts;
  check(pnpbs_placement_count(p, &m->owned), context);
  check(pnpbs_placement_ghost_count(p, &ghosts), context);
  m->all = m->owned + ghosts;
  m->x = room(3 * m->all, sizeof(double));
  m->spacing = room(m->owned, sizeof(double));
  m->tags = room(m->owned, sizeof(int32_t));
  check(pnpbs_placement_get_nodes(p, m->owned, m->x, NULL, m->tags, m->spacing), context);
  check(pnpbs_placement_get_ghosts(p, ghosts, m->x + 3 * m->owned, NULL, NULL, NULL, NULL),
        context);
  check(pnpbs_placement_get_tetrahedra(p, 0, &m->tetrahedra, NULL), context);
  m->corners = room(4 * m->tetrahedra, sizeof(int64_t));
  check(pnpbs_placement_get_tetrahedra(p, m->tetrahedra, &m->tetrahedra, m->corners), context);
}

static void get_exchange(pnpbs_placement p, pnpbs_context context, exchange *e) {
  int64_t sends, receives;
  check(pnpbs_placement_exchange_sizes(p, &e->neighbours, &sends, &receives), context);
  e->ranks = room(e->neighbours, sizeof(int32_t));
  e->shared.offsets = room(e->neighbours + 1, sizeof(int64_t));
  e->shared.nodes = room(sends, sizeof(int64_t));
  e->ghosts.offsets = room(e->neighbours + 1, sizeof(int64_t));
  e->ghosts.nodes = room(receives, sizeof(int64_t));
  check(pnpbs_placement_get_exchange(p, e->neighbours, sends, receives, e->ranks, e->shared.offsets,
                                     e->shared.nodes, e->ghosts.offsets, e->ghosts.nodes),
        context);
  e->shared.values = room(sends, sizeof(double));
  e->ghosts.values = room(receives, sizeof(double));
  e->requests = room(2 * e->neighbours, sizeof(MPI_Request));
}

static void release(mesh *m, exchange *e, solution *s) {
  void *all[] = {m->x,
                 m->spacing,
                 m->tags,
                 m->corners,
                 e->ranks,
                 e->shared.offsets,
                 e->shared.nodes,
                 e->shared.values,
                 e->ghosts.offsets,
                 e->ghosts.nodes,
                 e->ghosts.values,
                 e->requests,
                 s->u,
                 s->density,
                 s->volume};
  size_t i;
  for (i = 0; i < sizeof all / sizeof *all; ++i) free(all[i]);
}

/* ---------------------------------------------------------------- between ranks ---------- */

static double sum_over_ranks(const mesh *m, double part) {
  double sum;
  MPI_Allreduce(&part, &sum, 1, MPI_DOUBLE, MPI_SUM, m->comm);
  return sum;
}

/* Sends the values of x at the nodes of side `from` to the neighbours and receives those of side
 * `to` into to->values. Collective. */
static void transfer(const mesh *m, const exchange *e, const side *from, const side *to,
                     const double *x) {
  const int64_t *f = from->offsets, *t = to->offsets;
  int64_t i;
  int32_t k;
  for (k = 0; k < e->neighbours; ++k)
    MPI_Irecv(to->values + t[k], (int)(t[k + 1] - t[k]), MPI_DOUBLE, e->ranks[k], 0, m->comm,
              &e->requests[k]);
  for (i = 0; i < f[e->neighbours]; ++i) from->values[i] = x[from->nodes[i]];
  for (k = 0; k < e->neighbours; ++k)
    MPI_Isend(from->values + f[k], (int)(f[k + 1] - f[k]), MPI_DOUBLE, e->ranks[k], 0, m->comm,
              &e->requests[e->neighbours + k]);
  MPI_Waitall(2 * e->neighbours, e->requests, MPI_STATUSES_IGNORE);
}

/* Copies the values at nodes to their ghosts on other ranks. Collective. */
static void update_ghosts(const mesh *m, const exchange *e, double *x) {
  int64_t i;
  transfer(m, e, &e->shared, &e->ghosts, x);
  for (i = 0; i < e->ghosts.offsets[e->neighbours]; ++i)
    x[e->ghosts.nodes[i]] = e->ghosts.values[i];
}

/* Adds the sums at ghosts on other ranks to the owned nodes of this rank. Collective. */
static void add_ghosts(const mesh *m, const exchange *e, double *x) {
  int64_t i;
  transfer(m, e, &e->ghosts, &e->shared, x);
  for (i = 0; i < e->shared.offsets[e->neighbours]; ++i)
    x[e->shared.nodes[i]] += e->shared.values[i];
}

/* ---------------------------------------------------------------- linear elements -------- */

/* Corner numbers at the ends of the six edges of a tetrahedron. */
static const int edge_ends[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

static void cross(const double *a, const double *b, double *c) {
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot3(const double *a, const double *b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Computes the gradients of the four hat functions, each 1 at one corner and 0 at the others, and
 * returns the volume of the tetrahedron. */
static double hat_gradients(const mesh *m, const int64_t *corners, double hat[4][3]) {
  double edge[3][3], six_volumes;
  int i, k;
  for (k = 0; k < 3; ++k)
    for (i = 0; i < 3; ++i) edge[k][i] = m->x[3 * corners[k + 1] + i] - m->x[3 * corners[0] + i];
  for (k = 0; k < 3; ++k) cross(edge[(k + 1) % 3], edge[(k + 2) % 3], hat[k + 1]);
  six_volumes = dot3(edge[0], hat[1]);
  for (i = 0; i < 3; ++i) {
    for (k = 1; k < 4; ++k) hat[k][i] /= six_volumes;
    hat[0][i] = -hat[1][i] - hat[2][i] - hat[3][i];
  }
  return six_volumes / 6;
}

/* Computes the constant gradient of u on a tetrahedron and returns the volume. */
static double gradient(const mesh *m, const int64_t *corners, const double *u, double *g) {
  double hat[4][3];
  const double volume = hat_gradients(m, corners, hat);
  int i;
  for (i = 0; i < 3; ++i)
    g[i] = u[corners[0]] * hat[0][i] + u[corners[1]] * hat[1][i] + u[corners[2]] * hat[2][i] +
           u[corners[3]] * hat[3][i];
  return volume;
}

/* Computes stiffness[t][k], the integral of grad phi_a . grad phi_b over tetrahedron t for the ends
 * a and b of edge k, and the diagonal of the matrix. Each row sums to zero, so the entries of the
 * edges determine the diagonal. Collective. */
static void assemble(const mesh *m, const exchange *e, double *stiffness, double *diagonal) {
  int64_t t;
  int k;
  for (t = 0; t < m->tetrahedra; ++t) {
    const int64_t *c = m->corners + 4 * t;
    double hat[4][3];
    const double volume = hat_gradients(m, c, hat);
    for (k = 0; k < 6; ++k) {
      const int a = edge_ends[k][0], b = edge_ends[k][1];
      stiffness[6 * t + k] = -volume * dot3(hat[a], hat[b]);
      diagonal[c[a]] += stiffness[6 * t + k];
      diagonal[c[b]] += stiffness[6 * t + k];
    }
  }
  add_ghosts(m, e, diagonal);
}

/* Computes y = A x at the owned nodes. Updates the ghosts of x first. Collective. */
static void multiply(const mesh *m, const exchange *e, const double *stiffness, double *x,
                     double *y) {
  int64_t i, t;
  int k;
  update_ghosts(m, e, x);
  for (i = 0; i < m->all; ++i) y[i] = 0;
  for (t = 0; t < m->tetrahedra; ++t)
    for (k = 0; k < 6; ++k) {
      const int64_t a = m->corners[4 * t + edge_ends[k][0]];
      const int64_t b = m->corners[4 * t + edge_ends[k][1]];
      const double flow = stiffness[6 * t + k] * (x[a] - x[b]);
      y[a] += flow;
      y[b] -= flow;
    }
  add_ghosts(m, e, y);
}

static double dot(const mesh *m, const double *x, const double *y) {
  double part = 0;
  int64_t i;
  for (i = 0; i < m->owned; ++i) part += x[i] * y[i];
  return sum_over_ranks(m, part);
}

/* Solves A u = 0 at the inner nodes by conjugate gradients with the diagonal as preconditioner.
 * Values of u on the boundary do not change, because the residual is set to zero there. Collective.
 */
static void solve(const mesh *m, const exchange *e, double *u) {
  double *stiffness = room(6 * m->tetrahedra, sizeof(double));
  double *diagonal = room(m->all, sizeof(double)), *r = room(m->owned, sizeof(double));
  double *z = room(m->owned, sizeof(double)), *p = room(m->all, sizeof(double));
  double *q = room(m->all, sizeof(double)), rz, rz_before, enough, alpha;
  int64_t i;
  int steps = 0;
  assemble(m, e, stiffness, diagonal);
  multiply(m, e, stiffness, u, q);
  for (i = 0; i < m->owned; ++i) r[i] = m->tags[i] != 0 ? 0 : -q[i];
  for (i = 0; i < m->owned; ++i) p[i] = z[i] = r[i] / diagonal[i];
  rz = dot(m, r, z);
  enough = 1e-26 * rz;
  while (rz > enough) {
    if (++steps > 10000) {
      fprintf(stderr, "conjugate gradients do not converge\n");
      MPI_Abort(m->comm, 1);
    }
    multiply(m, e, stiffness, p, q);
    alpha = rz / dot(m, p, q);
    for (i = 0; i < m->owned; ++i) u[i] += alpha * p[i];
    for (i = 0; i < m->owned; ++i) r[i] = m->tags[i] != 0 ? 0 : r[i] - alpha * q[i];
    for (i = 0; i < m->owned; ++i) z[i] = r[i] / diagonal[i];
    rz_before = rz;
    rz = dot(m, r, z);
    for (i = 0; i < m->owned; ++i) p[i] = z[i] + rz / rz_before * p[i];
  }
  update_ghosts(m, e, u);
  free(stiffness);
  free(diagonal);
  free(r);
  free(z);
  free(p);
  free(q);
}

/* ---------------------------------------------------------------- the error -------------- */

/* Computes smooth[i][n], component i of the mean gradient of u over the tetrahedra at node n,
 * weighted by their volumes. Collective. */
static void average_gradients(const mesh *m, const exchange *e, const solution *s,
                              double *smooth[3]) {
  int64_t t, n;
  int i, k;
  for (t = 0; t < m->tetrahedra; ++t) {
    const int64_t *c = m->corners + 4 * t;
    double g[3];
    const double volume = gradient(m, c, s->u, g);
    for (k = 0; k < 4; ++k) {
      s->volume[c[k]] += volume / 4;
      for (i = 0; i < 3; ++i) smooth[i][c[k]] += volume / 4 * g[i];
    }
  }
  add_ghosts(m, e, s->volume);
  for (i = 0; i < 3; ++i) {
    add_ghosts(m, e, smooth[i]);
    for (n = 0; n < m->owned; ++n) smooth[i][n] /= s->volume[n];
    update_ghosts(m, e, smooth[i]);
  }
}

/* Returns the integral of (f - constant)^2 over a tetrahedron with corners c. f is given at the
 * nodes and linear on the tetrahedron. */
static double integral_of_square(double volume, const double *f, const int64_t *c,
                                 double constant) {
  double sum = 0, squares = 0;
  int k;
  for (k = 0; k < 4; ++k) {
    sum += f[c[k]] - constant;
    squares += pow(f[c[k]] - constant, 2);
  }
  return volume / 20 * (squares + sum * sum);
}

/* Estimates the error without the known solution: on each tetrahedron as the L2 distance between
 * the gradient of u and the averaged gradient (Zienkiewicz and Zhu 1987). Each corner receives a
 * quarter of the squared error. Collective. */
static void estimate(const mesh *m, const exchange *e, solution *s) {
  double *smooth[3], all = 0;
  int64_t t, n;
  int i, k;
  for (i = 0; i < 3; ++i) smooth[i] = room(m->all, sizeof(double));
  average_gradients(m, e, s, smooth);
  for (t = 0; t < m->tetrahedra; ++t) {
    const int64_t *c = m->corners + 4 * t;
    double g[3], part = 0;
    const double volume = gradient(m, c, s->u, g);
    for (i = 0; i < 3; ++i) part += integral_of_square(volume, smooth[i], c, g[i]);
    for (k = 0; k < 4; ++k) s->density[c[k]] += part / 4;
    all += part;
  }
  add_ghosts(m, e, s->density);
  for (n = 0; n < m->owned; ++n) s->density[n] /= s->volume[n];
  s->estimate = sqrt(sum_over_ranks(m, all));
  for (i = 0; i < 3; ++i) free(smooth[i]);
}

/* Returns the integral of |grad u - g|^2 over a tetrahedron with corners x by the four-point rule,
 * where u is the known solution. */
static double squared_error_by_points(double x[4][3], double volume, const double *g) {
  double sum = 0, point[3], known[3];
  int i, k;
  for (k = 0; k < 4; ++k) {
    for (i = 0; i < 3; ++i)
      point[i] = FAR * (x[0][i] + x[1][i] + x[2][i] + x[3][i]) + (NEAR - FAR) * x[k][i];
    known_gradient(point, known);
    for (i = 0; i < 3; ++i) sum += pow(known[i] - g[i], 2);
  }
  return volume / 4 * sum;
}

/* Returns the same integral with enough points near the re-entrant edge: a tetrahedron that is
 * large compared with its distance from that edge is bisected at its longest edge, at most 15
 * times. The rest of the singularity is negligible then. */
static double squared_error(double x[4][3], double volume, const double *g, int depth) {
  double longest = 0, middle[3], part[4][3], sum = 0, r = 0;
  int i, k, end, halved = 0;
  for (k = 0; k < 6; ++k) {
    double length = 0;
    for (i = 0; i < 3; ++i) length += pow(x[edge_ends[k][0]][i] - x[edge_ends[k][1]][i], 2);
    if (length > longest) longest = length, halved = k;
  }
  for (i = 0; i < 3; ++i) middle[i] = (x[0][i] + x[1][i] + x[2][i] + x[3][i]) / 4;
  r = distance(middle);
  if (depth == 15 || longest < 0.25 * r * r) return squared_error_by_points(x, volume, g);
  for (i = 0; i < 3; ++i) middle[i] = (x[edge_ends[halved][0]][i] + x[edge_ends[halved][1]][i]) / 2;
  for (end = 0; end < 2; ++end) {
    for (k = 0; k < 4; ++k)
      for (i = 0; i < 3; ++i) part[k][i] = k == edge_ends[halved][end] ? middle[i] : x[k][i];
    sum += squared_error(part, volume / 2, g, depth + 1);
  }
  return sum;
}

/* Returns the true error in the energy norm. Collective. */
static double energy_error(const mesh *m, const double *u) {
  double part = 0, g[3], x[4][3];
  int64_t t;
  int i, k;
  for (t = 0; t < m->tetrahedra; ++t) {
    const int64_t *c = m->corners + 4 * t;
    const double volume = gradient(m, c, u, g);
    for (k = 0; k < 4; ++k)
      for (i = 0; i < 3; ++i) x[k][i] = m->x[3 * c[k] + i];
    part += squared_error(x, volume, g, 0);
  }
  return sqrt(sum_over_ranks(m, part));
}

/* ---------------------------------------------------------------- rounds ----------------- */

static void solve_and_estimate(pnpbs_placement p, pnpbs_context context, mesh *m, exchange *e,
                               solution *s) {
  int64_t i;
  get_mesh(p, context, m);
  get_exchange(p, context, e);
  s->u = room(m->all, sizeof(double));
  s->density = room(m->all, sizeof(double));
  s->volume = room(m->all, sizeof(double));
  for (i = 0; i < m->owned; ++i)
    if (m->tags[i] != 0) s->u[i] = known_solution(m->x + 3 * i);
  solve(m, e, s->u);
  estimate(m, e, s);
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

/* Returns the number of nodes that a spacing implies, which is the integral of their density. d is
 * given at the nodes and linear on each tetrahedron; the integral uses the four-point rule.
 * Collective. */
static double nodes_of(const mesh *m, const double *d) {
  double part = 0, hat[4][3];
  int64_t t;
  int k;
  for (t = 0; t < m->tetrahedra; ++t) {
    const int64_t *c = m->corners + 4 * t;
    const double volume = hat_gradients(m, c, hat);
    const double sum = d[c[0]] + d[c[1]] + d[c[2]] + d[c[3]];
    for (k = 0; k < 4; ++k)
      part += volume / 4 * NODES_PER_CUBE * pow(FAR * sum + (NEAR - FAR) * d[c[k]], -3);
  }
  return sum_over_ranks(m, part);
}

/* Sets the spacing for which about `nodes` nodes share the error evenly. With spacing h and squared
 * error per volume w, the quotient w / h^2 does not depend on h, because it is about |second
 * derivatives|^2. A node with the new spacing d has the squared error w / h^2 d^5 around it; d
 * equalises this error over all nodes. One step changes d by factors between 1/8 and 1.5.
 * Collective. */
static void adapt(pnpbs_placement p, pnpbs_context context, const mesh *m, const exchange *e,
                  const solution *s, double nodes) {
  double *d = room(m->all, sizeof(double)), scale;
  int64_t i;
  for (i = 0; i < m->owned; ++i) d[i] = pow(m->spacing[i] * m->spacing[i] / s->density[i], 0.2);
  update_ghosts(m, e, d);
  scale = cbrt(nodes_of(m, d) / nodes);
  for (i = 0; i < m->owned; ++i) {
    const double h = m->spacing[i];
    d[i] = rounded(fmin(fmax(scale * d[i], h / 8), 1.5 * h));
  }
  check(pnpbs_placement_set_spacing_at_nodes(p, m->owned, d), context);
  free(d);
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
    printf("%s, round %d: %.0f nodes, least d %.5f, error %.5f, estimate over error %.3f\n", kind,
           round, s->nodes, least, s->error, s->estimate / s->error);
}

/* Writes FOLDER/adaptive_block_<rank>.vtk for ParaView. The field `estimate` is the root of the
 * estimated squared error per volume. */
static void write_piece(const char *folder, const mesh *m, const exchange *e, const solution *s) {
  const long all = (long)m->all, tetrahedra = (long)m->tetrahedra;
  const int64_t *c = m->corners;
  char path[1024];
  long i;
  int rank;
  FILE *file;
  MPI_Comm_rank(m->comm, &rank);
  snprintf(path, sizeof path, "%s/adaptive_block_%03d.vtk", folder, rank);
  file = fopen(path, "w");
  if (file == NULL) {
    fprintf(stderr, "cannot write %s\n", path);
    MPI_Abort(MPI_COMM_WORLD, 1);
    return;
  }
  fprintf(file, "# vtk DataFile Version 3.0\nadaptive_block\nASCII\nDATASET UNSTRUCTURED_GRID\n");
  fprintf(file, "POINTS %ld double\n", all);
  for (i = 0; i < all; ++i)
    fprintf(file, "%.9g %.9g %.9g\n", m->x[3 * i], m->x[3 * i + 1], m->x[3 * i + 2]);
  fprintf(file, "CELLS %ld %ld\n", tetrahedra, 5 * tetrahedra);
  for (i = 0; i < tetrahedra; ++i, c += 4)
    fprintf(file, "4 %ld %ld %ld %ld\n", (long)c[0], (long)c[1], (long)c[2], (long)c[3]);
  fprintf(file, "CELL_TYPES %ld\n", tetrahedra);
  for (i = 0; i < tetrahedra; ++i) fprintf(file, "10\n");
  fprintf(file, "POINT_DATA %ld\nSCALARS solution double\nLOOKUP_TABLE default\n", all);
  for (i = 0; i < all; ++i) fprintf(file, "%.9g\n", s->u[i]);
  fprintf(file, "SCALARS error double\nLOOKUP_TABLE default\n");
  for (i = 0; i < all; ++i) fprintf(file, "%.9g\n", fabs(s->u[i] - known_solution(m->x + 3 * i)));
  update_ghosts(m, e, s->density);
  fprintf(file, "SCALARS estimate double\nLOOKUP_TABLE default\n");
  for (i = 0; i < all; ++i) fprintf(file, "%.9g\n", sqrt(s->density[i]));
  fclose(file);
}

/* Numbers of nodes and errors of all rounds. `effectivity` is the estimate over the true error in
 * the last round. */
typedef struct {
  int rounds;
  double nodes[MOST_ROUNDS], errors[MOST_ROUNDS], effectivity;
} history;

static void remember(history *h, int round, const solution *s) {
  h->nodes[round] = s->nodes;
  h->errors[round] = s->error;
  h->effectivity = s->estimate / s->error;
}

/* Sets and returns the constant spacing that results in about `nodes` nodes.
 * pnpbs_placement_estimate predicts the number of nodes without placing them. Collective. */
static double set_uniform_spacing(pnpbs_placement p, pnpbs_context context, double nodes) {
  double d = cbrt(NODES_PER_CUBE * VOLUME / nodes);
  int64_t expected;
  int trial;
  for (trial = 0; trial < 4; ++trial) {
    check(pnpbs_placement_set_spacing_constant(p, d), context);
    check(pnpbs_placement_estimate(p, &expected, NULL, NULL), context);
    d *= cbrt((double)expected / nodes);
  }
  check(pnpbs_placement_set_spacing_constant(p, d), context);
  return d;
}

static void adapted_rounds(MPI_Comm comm, pnpbs_context context, pnpbs_domain domain,
                           const char *folder, history *h) {
  pnpbs_placement p;
  int round;
  check(pnpbs_placement_create(context, domain, &p), context);
  check(pnpbs_placement_set_double(p, "growth_limit", 0.4), context);
  set_uniform_spacing(p, context, FIRST_NODES);
  for (round = 0; round < h->rounds; ++round) {
    mesh m;
    exchange e;
    solution s;
    m.comm = comm;
    check(pnpbs_placement_run(p), context);
    solve_and_estimate(p, context, &m, &e, &s);
    print_round("adapted", round, &m, &s);
    remember(h, round, &s);
    if (round < h->rounds - 1) {
      adapt(p, context, &m, &e, &s, FIRST_NODES * pow(2, round + 1));
      check(pnpbs_placement_initialise(p), context); /* d is much smaller: start with a new fill */
    } else if (folder != NULL)
      write_piece(folder, &m, &e, &s);
    release(&m, &e, &s);
  }
  pnpbs_placement_destroy(&p);
}

/* Repeats the rounds with a constant d and about as many nodes. */
static void uniform_rounds(MPI_Comm comm, pnpbs_context context, pnpbs_domain domain,
                           const double *nodes, history *h) {
  int round;
  for (round = 0; round < h->rounds; ++round) {
    pnpbs_placement p;
    mesh m;
    exchange e;
    solution s;
    m.comm = comm;
    check(pnpbs_placement_create(context, domain, &p), context);
    set_uniform_spacing(p, context, nodes[round]);
    check(pnpbs_placement_run(p), context);
    solve_and_estimate(p, context, &m, &e, &s);
    print_round("uniform", round, &m, &s);
    remember(h, round, &s);
    release(&m, &e, &s);
    pnpbs_placement_destroy(&p);
  }
}

/* Returns the order of convergence p in error ~ N^(-p): minus the slope of log(error) over log(N),
 * fitted by least squares to the last four rounds. */
static double order(const history *h) {
  double x = 0, y = 0, xx = 0, xy = 0;
  const int n = 4;
  int i;
  for (i = h->rounds - n; i < h->rounds; ++i) {
    x += log(h->nodes[i]) / n;
    y += log(h->errors[i]) / n;
  }
  for (i = h->rounds - n; i < h->rounds; ++i) {
    xx += (log(h->nodes[i]) - x) * (log(h->nodes[i]) - x);
    xy += (log(h->nodes[i]) - x) * (log(h->errors[i]) - y);
  }
  return -xy / xx;
}

int main(int argc, char **argv) {
  const MPI_Comm comm = MPI_COMM_WORLD; /* or any other communicator */
  pnpbs_context context;
  pnpbs_domain domain;
  history adapted, uniform;
  double volume;
  int rank, rounds = argc > 1 ? atoi(argv[1]) : ROUNDS;

  MPI_Init(&argc, &argv);
  MPI_Comm_rank(comm, &rank);
  if (rounds < 4 || rounds > MOST_ROUNDS) {
    if (rank == 0) fprintf(stderr, "4 to %d rounds, not %s\n", MOST_ROUNDS, argv[1]);
    MPI_Finalize();
    return 1;
  }
  adapted.rounds = uniform.rounds = rounds;
  check(pnpbs_context_create_mpi(comm, &context), NULL);
  check(pnpbs_domain_create(context, 3, &domain), context);
  add_block(domain, context);
  check(pnpbs_domain_measure(domain, &volume), context);
  adapted_rounds(comm, context, domain, argc > 2 ? argv[2] : NULL, &adapted);
  uniform_rounds(comm, context, domain, adapted.nodes, &uniform);
  if (rank == 0) {
    const int last = adapted.rounds - 1;
    printf("volume: %.6f, expected 3\n", volume);
    printf("nodes: %.0f, expected at least 6000\n", adapted.nodes[last]);
    printf("order of the error when adapted: %.3f, expected at least 0.33\n", order(&adapted));
    printf("order of the error when uniform: %.3f, expected at most 0.27\n", order(&uniform));
    printf("error when uniform over that when adapted: %.2f, expected at least 1.7\n",
           uniform.errors[last] / adapted.errors[last]);
    printf("estimate over error, adapted: %.3f, expected at most 1.1\n", adapted.effectivity);
    printf("error over estimate, adapted: %.3f, expected at most 1.1\n", 1 / adapted.effectivity);
  }
  pnpbs_domain_destroy(&domain);
  pnpbs_context_destroy(&context);
  MPI_Finalize();
  return 0;
}
