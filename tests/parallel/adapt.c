/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests a complete adaptive sequence: a callback, values at nodes, a grid, and values at nodes
 * again, with a run after each. The nodes equal those of one process, to the bit. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rank_program.h"

static int32_t first_spacing(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  int64_t i;
  (void)user;
  for (i = 0; i < n; ++i) d[i] = 0.05 + 0.03 * x[dim * i];
  return 0;
}

/* Returns the spacing that an error estimate would request: finer at a front, bounded below and
 * above. */
static double wanted(const double* x, double d, double front) {
  const double t = fabs(x[0] + 0.3 * x[1] - front) / 0.15;
  return fmin(fmax(d * (t < 1 ? 0.5 + 0.5 * t : 1.2), 0.02), 0.08);
}

static pnpbs_status set_at_nodes(pnpbs_placement placement, double front) {
  int64_t n, i;
  double *xy, *d;
  pnpbs_status status;
  expect(pnpbs_placement_count(placement, &n) == PNPBS_OK, "count");
  xy = malloc(((size_t)n + 1) * 2 * sizeof(double));
  d = malloc(((size_t)n + 1) * sizeof(double));
  expect(pnpbs_placement_get_nodes(placement, n, xy, NULL, NULL, d) == PNPBS_OK, "nodes");
  for (i = 0; i < n; ++i) d[i] = wanted(xy + 2 * i, d[i], front);
  status = pnpbs_placement_set_spacing_at_nodes(placement, n, d);
  free(xy), free(d);
  return status;
}

static void note_hash(pnpbs_placement placement, char* hashes) {
  const char* hash;
  expect(pnpbs_placement_get_string(placement, "hash", &hash) == PNPBS_OK, "hash");
  strcat(strcat(hashes, hash), " ");
}

/* Writes the hashes after each run, one after the other. */
static void sequence(const char* growth_limit, char* hashes) {
  const double box[] = {0, 0, 1.5, 0, 1.5, 1, 0, 1}, centre[] = {0.7, 0.5};
  const int64_t grid_size[] = {3, 2};
  const double origin[] = {0, 0}, step[] = {0.75, 1},
               values[] = {0.04, 0.06, 0.05, 0.05, 0.04, 0.06};
  pnpbs_domain domain;
  pnpbs_placement placement;
  hashes[0] = 0;
  pnpbs_domain_create(context, 2, &domain);
  pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, box, NULL, 0);
  pnpbs_domain_add_arc(domain, PNPBS_BOUNDARY, centre, 0.25, 0, 2 * acos(-1.0), 2);
  expect(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  pnpbs_placement_set_int64(placement, "steps", 60);
  expect(pnpbs_placement_set(placement, "growth_limit", growth_limit) == PNPBS_OK, "growth limit");
  expect(set_at_nodes(placement, 0) == PNPBS_ERROR_STATE, "no nodes to give values at");
  pnpbs_placement_set_spacing_callback(placement, first_spacing, NULL);
  expect(pnpbs_placement_run(placement) >= 0, "from a callback");
  note_hash(placement, hashes);
  expect(set_at_nodes(placement, 0.5) == PNPBS_OK, "values at nodes");
  expect(pnpbs_placement_run(placement) >= 0, "from values at nodes");
  note_hash(placement, hashes);
  expect(set_at_nodes(placement, 0.6) == PNPBS_OK, "values at nodes placed from values at nodes");
  expect(pnpbs_placement_run(placement) >= 0, "from values at nodes placed from values at nodes");
  note_hash(placement, hashes);
  expect(pnpbs_placement_set_spacing_grid(placement, grid_size, origin, step, values) == PNPBS_OK,
         "grid");
  expect(pnpbs_placement_run(placement) >= 0, "from a grid");
  note_hash(placement, hashes);
  expect(set_at_nodes(placement, 1.1) == PNPBS_OK, "values at nodes again");
  expect(pnpbs_placement_run(placement) >= 0, "from values at nodes again");
  note_hash(placement, hashes);
  pnpbs_placement_destroy(&placement);
  pnpbs_domain_destroy(&domain);
}

/* Compares the sequence on all ranks with that on one rank. */
static void compare(const char* growth_limit) {
  char together[200], alone[200];
  pnpbs_context all = context;
  sequence(growth_limit, together);
  expect(pnpbs_context_create_serial(&context) == PNPBS_OK, "serial context");
  if (rank == 0) {
    sequence(growth_limit, alone);
    if (strcmp(together, alone) != 0)
      fprintf(stderr, "together %s\nalone    %s\n", together, alone);
    expect(strcmp(together, alone) == 0, "other nodes than one process places");
    expect(strlen(alone) > 5 * 8, "five hashes");
  }
  pnpbs_context_destroy(&context);
  context = all;
}

static void expect_bad_value(pnpbs_placement placement, int on_rank, double value) {
  int64_t n, *ids;
  double* d;
  char id[40] = "", begin[40], text[40];
  const char* message;
  pnpbs_placement_count(placement, &n);
  ids = malloc(((size_t)n + 1) * sizeof(int64_t));
  d = malloc(((size_t)n + 1) * sizeof(double));
  pnpbs_placement_get_nodes(placement, n, NULL, ids, NULL, d);
  if (rank == on_rank) {
    d[n / 2] = value;
    snprintf(id, sizeof id, "node %lld:", (long long)ids[n / 2]);
  }
  MPI_Bcast(id, sizeof id, MPI_CHAR, on_rank, group);
  snprintf(begin, sizeof begin, size > 1 ? "rank %d: " : "argument", on_rank);
  snprintf(text, sizeof text, "= %g at", value);
  expect(pnpbs_placement_set_spacing_at_nodes(placement, n, d) == PNPBS_ERROR_SPACING,
         "a bad value on one rank is every rank's error");
  message = pnpbs_last_error(context);
  expect(strncmp(message, begin, strlen(begin)) == 0, begin);
  expect(strstr(message, id) != NULL, id);
  expect(strstr(message, text) != NULL, text);
  if (rank == on_rank) --n; /* omit a value on one rank */
  d[n > 0 ? n / 2 : 0] = 0.05;
  expect(pnpbs_placement_set_spacing_at_nodes(placement, n, d) == PNPBS_ERROR_ARGUMENT,
         "a missing value");
  free(ids), free(d);
}

static void bad_values(void) {
  const double box[] = {0, 0, 1, 0, 1, 1, 0, 1};
  pnpbs_domain domain;
  pnpbs_placement placement;
  pnpbs_domain_create(context, 2, &domain);
  pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, box, NULL, 0);
  pnpbs_placement_create(context, domain, &placement);
  pnpbs_placement_set_spacing_constant(placement, 0.05);
  expect(pnpbs_placement_initialise(placement) == PNPBS_OK, "initialise");
  expect_bad_value(placement, size - 1, 0);
  expect_bad_value(placement, 0, NAN);
  expect_bad_value(placement, size / 2, -0.5);
  expect(set_at_nodes(placement, 0.5) == PNPBS_OK, "good values after bad ones");
  expect(pnpbs_placement_run(placement) >= 0, "run after bad values");
  pnpbs_placement_destroy(&placement);
  pnpbs_domain_destroy(&domain);
}

static void check_all(void) {
  compare("0");
  compare("0.2");
  bad_values();
}

int main(int argc, char** argv) { return run_in_groups(argc, argv, check_all); }
