/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Places the nodes of many small bodies. Prints a line for each with the hash, the number of nodes,
 * and a hash of the statistics of the elements, none of which depends on the number of ranks and
 * threads.
 * usage: volume_hashes DATA [CASE [key=value]...]
 * The CASE "all" runs all cases. */
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>
#include <stdlib.h>
#include <string.h>

#include "volume_cases.h"

static pnpbs_context context;
static int rank, size;
static const char* data_folder;
static char** settings; /* "key=value", split at the equals sign */
static int setting_count;

static void check(pnpbs_status status, const char* what) {
  if (status >= 0) return;
  fprintf(stderr, "rank %d: %s: %s\n", rank, what, pnpbs_last_error(context));
  MPI_Abort(MPI_COMM_WORLD, 1);
}

/* ---------------------------------------------------------------- statistics ------------ */

/* Returns the FNV-1a hash after the bits of a further value. */
static uint64_t mixed(uint64_t hash, double value) {
  unsigned char bytes[sizeof value];
  size_t k;
  memcpy(bytes, &value, sizeof value);
  for (k = 0; k < sizeof bytes; ++k) hash = (hash ^ bytes[k]) * 0x100000001b3u;
  return hash;
}

static uint64_t hash_of_elements(pnpbs_placement placement, pnpbs_status outcome) {
  const char* keys[] = {"quality.mean",
                        "quality.one_percent",
                        "quality.min",
                        "quality.min_angle",
                        "edge.mean",
                        "edge.deviation",
                        "quality.min_angle_elsewhere"};
  double from[8], to[8], mean[8], deviation[8], value;
  int64_t edges[8], bands, b;
  uint64_t hash = mixed(0xcbf29ce484222325u, (double)outcome);
  size_t k;
  for (k = 0; k < sizeof keys / sizeof keys[0]; ++k) {
    check(pnpbs_placement_get_double(placement, keys[k], &value), keys[k]);
    hash = mixed(hash, value);
  }
  check(pnpbs_placement_get_edge_bands(placement, 8, &bands, from, to, edges, mean, deviation),
        "bands");
  for (b = 0; b < bands; ++b) {
    hash = mixed(mixed(hash, from[b]), to[b]);
    hash = mixed(mixed(mixed(hash, (double)edges[b]), mean[b]), deviation[b]);
  }
  return hash;
}

static void run_and_print(pnpbs_placement placement, const char* name, int stage) {
  const char* hash;
  int64_t nodes;
  uint64_t elements;
  const pnpbs_status outcome = pnpbs_placement_run(placement);
  check(outcome, name);
  check(pnpbs_placement_check(placement), name);
  elements = hash_of_elements(placement, outcome);
  check(pnpbs_placement_get_int64(placement, "nodes", &nodes), name);
  check(pnpbs_placement_get_string(placement, "hash", &hash), name);
  if (rank != 0) return;
  printf("%s-%d %s %lld %016llx\n", name, stage, hash, (long long)nodes,
         (unsigned long long)elements);
  fflush(stdout);
}

/* ---------------------------------------------------------------- the cases ------------- */

static pnpbs_placement placement_in(volume_body body) {
  pnpbs_domain domain;
  pnpbs_placement placement;
  int k;
  check(pnpbs_domain_create(context, 3, &domain), "domain");
  check(body(domain, data_folder), "body");
  check(pnpbs_placement_create(context, domain, &placement), "placement");
  check(pnpbs_domain_destroy(&domain), "domain");
  for (k = 0; k < setting_count; ++k)
    check(pnpbs_placement_set(placement, settings[k], strchr(settings[k], 0) + 1), settings[k]);
  return placement;
}

static void set_spacing(pnpbs_placement placement, struct volume_spacing* spacing) {
  check(pnpbs_placement_set_spacing_callback(placement, volume_spacing_at, spacing), "spacing");
}

static void place(const struct volume_case* job) {
  struct volume_spacing spacing = job->spacing;
  pnpbs_placement placement = placement_in(job->body);
  set_spacing(placement, &spacing);
  run_and_print(placement, job->name, 0);
  check(pnpbs_placement_destroy(&placement), job->name);
}

/* Adapts one live placement to a spacing refined by two towards a corner, to values at nodes, and
 * to a grid. */
static void adapt(void) {
  const int64_t grid_size[] = {2, 2, 1};
  const double origin[] = {0, 0, 0}, step[] = {1, 1, 1}, values[] = {0.06, 0.1, 0.1, 0.06};
  struct volume_spacing even = VOLUME_CONSTANT(0.08), corner = VOLUME_GRADED(0.04, 0.07, 1, 1, 1);
  pnpbs_placement placement = placement_in(volume_unit_box);
  int64_t n, i;
  double* d;
  set_spacing(placement, &even);
  run_and_print(placement, "adapt", 0);
  set_spacing(placement, &corner);
  run_and_print(placement, "adapt", 1);
  check(pnpbs_placement_count(placement, &n), "count");
  d = malloc(((size_t)n + 1) * sizeof(double));
  check(pnpbs_placement_get_nodes(placement, n, NULL, NULL, NULL, d), "nodes");
  for (i = 0; i < n; ++i) d[i] *= 0.9;
  check(pnpbs_placement_set_spacing_at_nodes(placement, n, d), "values at nodes");
  free(d);
  run_and_print(placement, "adapt", 2);
  check(pnpbs_placement_set_spacing_grid(placement, grid_size, origin, step, values), "grid");
  run_and_print(placement, "adapt", 3);
  check(pnpbs_placement_destroy(&placement), "adapt");
}

/* Begins with given points of a box larger than the body. Every rank passes every size-th point. */
static void begin_with_given_nodes(void) {
  enum { row = 20, all = row * row * row };
  struct volume_spacing spacing = VOLUME_CONSTANT(0.16);
  pnpbs_placement placement = placement_in(volume_globe);
  double* xyz = malloc(all * 3 * sizeof(double));
  int64_t* ids = malloc(all * sizeof(int64_t));
  int64_t n = 0, k;
  for (k = rank; k < all; k += size, ++n) {
    xyz[3 * n] = 0.125 * (double)(k % row) - 1.1875 + 0.0078125 * (double)(k % 3);
    xyz[3 * n + 1] = 0.125 * (double)(k / row % row) - 1.1875 + 0.0078125 * (double)(k % 5);
    xyz[3 * n + 2] = 0.125 * (double)(k / (row * row)) - 1.1875 + 0.0078125 * (double)(k % 7);
    ids[n] = 100000 + k;
  }
  set_spacing(placement, &spacing);
  check(pnpbs_placement_set_nodes(placement, n, xyz, ids), "given nodes");
  run_and_print(placement, "given-nodes", 0);
  check(pnpbs_placement_destroy(&placement), "given nodes");
  free(xyz), free(ids);
}

/* Calls steps, population control and rebalancing directly instead of a run. */
static void drive_by_steps(void) {
  struct volume_spacing spacing = VOLUME_GRADED(0.05, 0.1, 0, 0, 0);
  pnpbs_placement placement = placement_in(volume_l_block);
  int k;
  set_spacing(placement, &spacing);
  check(pnpbs_placement_initialise(placement), "initialise");
  for (k = 0; k < 3; ++k) {
    check(pnpbs_placement_step(placement, 17), "step");
    check(pnpbs_placement_adjust_population(placement, NULL, NULL), "population");
    check(pnpbs_placement_rebalance(placement), "rebalance");
  }
  run_and_print(placement, "by-steps", 0);
  check(pnpbs_placement_destroy(&placement), "steps");
}

/* Runs rounds that reduce d at small angles, the last of which may bring no improvement. In the
 * second body most nodes are corners of elements with a small angle. */
static void enlarge_angles(void) {
  static const struct {
    volume_body body;
    double d;
  } cases[] = {{volume_bracket, 6}, {volume_rough_globe, 0.4}};
  int k;
  for (k = 0; k < 2; ++k) {
    struct volume_spacing spacing = VOLUME_CONSTANT(cases[k].d);
    pnpbs_placement placement = placement_in(cases[k].body);
    int64_t places;
    set_spacing(placement, &spacing);
    check(pnpbs_placement_set(placement, "min_angle", "25"), "min_angle");
    run_and_print(placement, "small-angles", k);
    check(pnpbs_placement_get_int64(placement, "unresolved_places", &places), "places");
    if (rank == 0) printf("small-angles at %lld places\n", (long long)places);
    check(pnpbs_placement_destroy(&placement), "small angles");
  }
}

int main(int argc, char** argv) {
  const char* only;
  int k;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  if (argc < 2) {
    fprintf(stderr, "usage: volume_hashes DATA [CASE [key=value]...]\n");
    MPI_Abort(MPI_COMM_WORLD, 2);
  }
  data_folder = argv[1];
  only = argc > 2 && strcmp(argv[2], "all") != 0 ? argv[2] : NULL;
  settings = argv + 3;
  setting_count = argc > 3 ? argc - 3 : 0;
  for (k = 0; k < setting_count; ++k)
    if (strchr(settings[k], '=')) *strchr(settings[k], '=') = 0;
  check(pnpbs_context_create_mpi(MPI_COMM_WORLD, &context), "context");
  for (k = 0; k < VOLUME_CASES; ++k)
    if (!only || strcmp(only, volume_cases[k].name) == 0) place(&volume_cases[k]);
  if (!only || strcmp(only, "adapt") == 0) adapt();
  if (!only || strcmp(only, "given-nodes") == 0) begin_with_given_nodes();
  if (!only || strcmp(only, "by-steps") == 0) drive_by_steps();
  if (!only || strcmp(only, "small-angles") == 0) enlarge_angles();
  check(pnpbs_context_destroy(&context), "context");
  MPI_Finalize();
  return 0;
}
