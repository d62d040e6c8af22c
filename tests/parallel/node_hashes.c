/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Places the nodes of many small cases of every kind and prints a line with the hash of each. The
 * hashes must not change when code is moved without being changed. node_hashes.sh runs it on
 * several numbers of ranks and threads and compares.
 * usage: node_hashes DATA [CASE] */
#include <math.h>
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static pnpbs_context context;
static int rank, size;

static void check(pnpbs_status status, const char* what) {
  if (status >= 0) return;
  fprintf(stderr, "rank %d: %s: %s\n", rank, what, pnpbs_last_error(context));
  MPI_Abort(MPI_COMM_WORLD, 1);
}

/* ---------------------------------------------------------------- domains --------------- */

static const double pi = 3.14159265358979323846;
static const double square_corners[] = {0, 0, 1, 0, 1, 1, 0, 1};
static char data_folder[4096];

static void add_square(pnpbs_domain domain) {
  check(pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square_corners, NULL, 0), "square");
}

static void add_circle(pnpbs_domain domain, int32_t role, double x, double y, double radius) {
  const double centre[] = {x, y};
  check(pnpbs_domain_add_arc(domain, role, centre, radius, 0, 2 * pi, 2), "circle");
}

static void read_file(pnpbs_domain domain, const char* name) {
  char path[4200];
  snprintf(path, sizeof path, "%s/%s", data_folder, name);
  check(pnpbs_domain_read_poly(domain, path), path);
}

static void add_lake(pnpbs_domain domain) { read_file(domain, "lake_victoria.poly"); }
static void add_islands(pnpbs_domain domain) { read_file(domain, "great_lakes_islands.poly"); }

static void add_annulus(pnpbs_domain domain) {
  add_circle(domain, PNPBS_BOUNDARY, 0.5, 0.5, 0.5);
  add_circle(domain, PNPBS_BOUNDARY, 0.5, 0.5, 0.2);
}

static int32_t wave(int64_t n, int32_t dim, const double* t, double* xy, void* user) {
  (void)dim;
  int64_t i;
  (void)user;
  for (i = 0; i < n; ++i) {
    xy[2 * i] = t[i];
    xy[2 * i + 1] = 0.6 + 0.4 * t[i] * (t[i] - 0.5) * (t[i] - 1);
  }
  return 0;
}

/* Adds a ring, a polyline that ends inside, and a curve from side to side as inner curves. */
static void add_square_with_inner_curves(pnpbs_domain domain) {
  const double hook[] = {0.1, 0.1, 0.4, 0.15, 0.35, 0.4};
  add_square(domain);
  add_circle(domain, PNPBS_INNER, 0.7, 0.3, 0.15);
  check(pnpbs_domain_add_polyline(domain, PNPBS_INNER, 0, 3, hook, NULL, 0), "hook");
  check(pnpbs_domain_add_curve(domain, PNPBS_INNER, wave, NULL, 0, 1, 5), "wave");
}

static void add_square_with_fixed_nodes(pnpbs_domain domain) {
  const double nodes[] = {0.31, 0.42, 0.312, 0.45, 0.8, 0.77, 0.5, 0.061, 0.93, 0.5};
  add_square(domain);
  check(pnpbs_domain_add_fixed_nodes(domain, 5, nodes, NULL), "fixed nodes");
}

/* Adds holes without room for a node in between, and one barely larger than d. */
static void add_square_with_small_holes(pnpbs_domain domain) {
  add_square(domain);
  add_circle(domain, PNPBS_BOUNDARY, 0.4, 0.4, 0.004);
  add_circle(domain, PNPBS_BOUNDARY, 0.41, 0.4, 0.003);
  add_circle(domain, PNPBS_BOUNDARY, 0.7, 0.61, 0.02);
}

static void add_sharp_corner(pnpbs_domain domain) {
  const double corners[] = {0, 0, 1, 0, 0.55, 0.04, 1, 0.7, 0, 1};
  check(pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 5, corners, NULL, 0), "sharp corner");
}

/* ---------------------------------------------------------------- spacings -------------- */
/* A spacing from + - * / and square roots only, which have the same bits everywhere. */

struct spacing {
  double constant, slope, x, y; /* grows from a point, or from a line if x is nan */
  double max;
  double line, beyond; /* another value right of a line */
};

static int32_t spacing_at(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  const struct spacing* s = user;
  int64_t i;
  for (i = 0; i < n; ++i) {
    const double u = x[dim * i] - s->x, v = x[dim * i + 1] - s->y;
    const double away = isnan(s->x) ? fabs(v) : sqrt(u * u + v * v);
    const double grown = s->constant + s->slope * away;
    d[i] = x[dim * i] > s->line ? s->beyond : grown < s->max ? grown : s->max;
  }
  return 0;
}

#define EVERYWHERE HUGE_VAL, HUGE_VAL, 0

/* ---------------------------------------------------------------- the cases ------------- */

struct placing {
  const char* name;
  void (*add_curves)(pnpbs_domain);
  struct spacing spacing;
  const char* options[9];
};

static const struct placing placings[] = {
    {"square", add_square, {0.02, 0, 0, 0, EVERYWHERE}, {NULL}},
    {"square-best", add_square, {0.02, 0, 0, 0, EVERYWHERE}, {"effort", "best", NULL}},
    {"square-paper", add_square, {0.025, 0, 0, 0, EVERYWHERE}, {"method", "paper", NULL}},
    {"graded", add_square, {0.005, 0.06, 0.5, 0.5, EVERYWHERE}, {NULL}},
    {"graded-best", add_square, {0.005, 0.06, 0.5, 0.5, EVERYWHERE}, {"effort", "best", NULL}},
    {"graded-paper", add_square, {0.01, 0.06, 0.3, 0.5, EVERYWHERE}, {"method", "paper", NULL}},
    {"line", add_square, {0.001, 0.2, NAN, 0.5, 0.08, HUGE_VAL, 0}, {NULL}},
    {"line-best", add_square, {0.002, 0.2, NAN, 0.5, 0.08, HUGE_VAL, 0}, {"effort", "best", NULL}},
    {"jump", add_square, {0.06, 0, 0, 0, HUGE_VAL, 0.52, 0.009}, {NULL}},
    {"jump-unlimited",
     add_square,
     {0.06, 0, 0, 0, HUGE_VAL, 0.52, 0.012},
     {"growth_limit", "0", "steps", "60", NULL}},
    {"steep", add_square, {0.0005, 0.9, 0.3, 0.4, EVERYWHERE}, {NULL}},
    {"slow-growth", add_square, {0.001, 0.4, 0.3, 0.4, EVERYWHERE}, {"growth_limit", "0.1", NULL}},
    {"lake", add_lake, {3, 0, 0, 0, EVERYWHERE}, {NULL}},
    {"lake-graded", add_lake, {1, 0.025, 0, 0, EVERYWHERE}, {NULL}},
    {"lake-best", add_lake, {2, 0.035, 0, 0, EVERYWHERE}, {"effort", "best", NULL}},
    {"islands", add_islands, {6, 0, 0, 0, EVERYWHERE}, {NULL}},
    {"islands-graded", add_islands, {3, 0.03, 0, 0, EVERYWHERE}, {NULL}},
    {"islands-limited", add_islands, {4, 0.03, 0, 0, EVERYWHERE}, {"growth_limit", "0.02", NULL}},
    {"annulus", add_annulus, {0.015, 0, 0, 0, EVERYWHERE}, {NULL}},
    {"annulus-best", add_annulus, {0.006, 0.06, 0.5, 0.8, EVERYWHERE}, {"effort", "best", NULL}},
    {"annulus-paper", add_annulus, {0.02, 0, 0, 0, EVERYWHERE}, {"method", "paper", NULL}},
    {"inner-curves", add_square_with_inner_curves, {0.02, 0, 0, 0, EVERYWHERE}, {NULL}},
    {"inner-curves-graded",
     add_square_with_inner_curves,
     {0.006, 0.05, 0.7, 0.3, EVERYWHERE},
     {NULL}},
    {"fixed-nodes", add_square_with_fixed_nodes, {0.02, 0, 0, 0, EVERYWHERE}, {NULL}},
    {"fixed-nodes-best",
     add_square_with_fixed_nodes,
     {0.02, 0, 0, 0, EVERYWHERE},
     {"effort", "best", NULL}},
    {"small-holes", add_square_with_small_holes, {0.03, 0, 0, 0, EVERYWHERE}, {NULL}},
    {"small-holes-graded",
     add_square_with_small_holes,
     {0.01, 0.1, 1, 1, EVERYWHERE},
     {"topology_repairs", "1", NULL}},
    {"sharp-corner", add_sharp_corner, {0.01, 0.03, 0, 0, EVERYWHERE}, {NULL}},
    {"wide-lists",
     add_annulus,
     {0.02, 0.02, 0.2, 0.2, EVERYWHERE},
     {"list_radius", "2.2", "adjacency_radius", "2.6", NULL}},
    {"old-scheme",
     add_square,
     {0.02, 0.03, 0, 0, EVERYWHERE},
     {"scheme", "predictor_corrector", "finish", "runge_kutta", "law", "cubic", NULL}},
    {"few-nodes", add_square, {0.4, 0, 0, 0, EVERYWHERE}, {NULL}},
};

static pnpbs_placement placement_on(void (*add_curves)(pnpbs_domain)) {
  pnpbs_domain domain;
  pnpbs_placement placement;
  check(pnpbs_domain_create(context, 2, &domain), "domain");
  add_curves(domain);
  check(pnpbs_placement_create(context, domain, &placement), "placement");
  check(pnpbs_domain_destroy(&domain), "domain");
  return placement;
}

static void run_and_print(pnpbs_placement placement, const char* name, int stage) {
  const char* hash;
  int64_t nodes;
  check(pnpbs_placement_run(placement), name);
  check(pnpbs_placement_check(placement), name);
  check(pnpbs_placement_get_string(placement, "hash", &hash), name);
  check(pnpbs_placement_get_int64(placement, "nodes", &nodes), name);
  if (rank != 0) return;
  printf("%s-%d %s %lld\n", name, stage, hash, (long long)nodes);
  fflush(stdout);
}

static void place(const struct placing* job) {
  struct spacing spacing = job->spacing;
  pnpbs_placement placement = placement_on(job->add_curves);
  int k;
  for (k = 0; job->options[k]; k += 2)
    check(pnpbs_placement_set(placement, job->options[k], job->options[k + 1]), job->options[k]);
  check(pnpbs_placement_set_spacing_callback(placement, spacing_at, &spacing), job->name);
  run_and_print(placement, job->name, 0);
  check(pnpbs_placement_destroy(&placement), job->name);
}

/* ---------------------------------------------------------------- sequences ------------- */

/* Refines d at a front, as after an error estimate. */
static void refine_at(pnpbs_placement placement, double front) {
  int64_t n, i;
  double *xy, *d;
  check(pnpbs_placement_count(placement, &n), "count");
  xy = malloc(((size_t)n + 1) * 2 * sizeof(double));
  d = malloc(((size_t)n + 1) * sizeof(double));
  check(pnpbs_placement_get_nodes(placement, n, xy, NULL, NULL, d), "nodes");
  for (i = 0; i < n; ++i) {
    const double t = fabs(xy[2 * i] + 0.25 * xy[2 * i + 1] - front) * 8;
    d[i] *= t < 1 ? 0.5 + 0.5 * t : 1.125;
  }
  check(pnpbs_placement_set_spacing_at_nodes(placement, n, d), "values at nodes");
  free(xy), free(d);
}

/* Adapts one live placement to a moving spot, to values at nodes and to a grid. */
static void adapt(void) {
  const int64_t grid_size[] = {3, 2};
  const double origin[] = {0, 0}, step[] = {0.5, 1},
               values[] = {0.02, 0.04, 0.03, 0.03, 0.02, 0.04};
  struct spacing spot = {0.006, 0.08, 0.3, 0.3, EVERYWHERE};
  pnpbs_placement placement = placement_on(add_annulus);
  int stage = 0;
  check(pnpbs_placement_set_spacing_callback(placement, spacing_at, &spot), "spot");
  run_and_print(placement, "adapt", stage++);
  spot.x = 0.7;
  check(pnpbs_placement_set_spacing_callback(placement, spacing_at, &spot), "spot moved");
  run_and_print(placement, "adapt", stage++);
  refine_at(placement, 0.5);
  run_and_print(placement, "adapt", stage++);
  refine_at(placement, 0.6);
  run_and_print(placement, "adapt", stage++);
  check(pnpbs_placement_set_spacing_grid(placement, grid_size, origin, step, values), "grid");
  run_and_print(placement, "adapt", stage++);
  check(pnpbs_placement_set(placement, "effort", "best"), "effort");
  run_and_print(placement, "adapt", stage++);
  check(pnpbs_placement_destroy(&placement), "adapt");
}

/* Begins with given points of the square, some of them outside the domain. Every rank passes every
 * size-th point. */
static void begin_with_given_nodes(void) {
  enum { rows = 40 };
  const struct spacing spacing = {0.02, 0.02, 0.1, 0.1, EVERYWHERE};
  struct spacing copy = spacing;
  pnpbs_placement placement = placement_on(add_annulus);
  double* xy = malloc(rows * rows * 2 * sizeof(double));
  int64_t* ids = malloc(rows * rows * sizeof(int64_t));
  int64_t n = 0, k;
  for (k = rank; k < rows * rows; k += size, ++n) {
    xy[2 * n] = (double)(k % rows) / rows + 0.0078125 * (double)(k % 3);
    xy[2 * n + 1] = (double)(k / rows) / rows + 0.0078125 * (double)(k % 5);
    ids[n] = 100000 + k;
  }
  check(pnpbs_placement_set_spacing_callback(placement, spacing_at, &copy), "spacing");
  check(pnpbs_placement_set_nodes(placement, n, xy, ids), "given nodes");
  run_and_print(placement, "given-nodes", 0);
  check(pnpbs_placement_destroy(&placement), "given nodes");
  free(xy), free(ids);
}

/* Calls steps, population control and rebalancing directly instead of a run. */
static void drive_by_steps(void) {
  struct spacing spacing = {0.006, 0.05, 0.2, 0.8, EVERYWHERE};
  pnpbs_placement placement = placement_on(add_square_with_inner_curves);
  int k;
  check(pnpbs_placement_set_spacing_callback(placement, spacing_at, &spacing), "spacing");
  check(pnpbs_placement_initialise(placement), "initialise");
  for (k = 0; k < 3; ++k) {
    int64_t inserted, deleted;
    check(pnpbs_placement_step(placement, 17), "step");
    check(pnpbs_placement_adjust_population(placement, &inserted, &deleted), "population");
    check(pnpbs_placement_rebalance(placement), "rebalance");
  }
  run_and_print(placement, "by-steps", 0);
  check(pnpbs_placement_destroy(&placement), "steps");
}

int main(int argc, char** argv) {
  const char* only = argc > 2 ? argv[2] : NULL;
  size_t k;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  if (argc < 2) {
    fprintf(stderr, "usage: node_hashes DATA [CASE]\n");
    MPI_Abort(MPI_COMM_WORLD, 2);
  }
  snprintf(data_folder, sizeof data_folder, "%s", argv[1]);
  check(pnpbs_context_create_mpi(MPI_COMM_WORLD, &context), "context");
  for (k = 0; k < sizeof placings / sizeof placings[0]; ++k)
    if (!only || strcmp(only, placings[k].name) == 0) place(&placings[k]);
  if (!only || strcmp(only, "adapt") == 0) adapt();
  if (!only || strcmp(only, "given-nodes") == 0) begin_with_given_nodes();
  if (!only || strcmp(only, "by-steps") == 0) drive_by_steps();
  check(pnpbs_context_destroy(&context), "context");
  MPI_Finalize();
  return 0;
}
