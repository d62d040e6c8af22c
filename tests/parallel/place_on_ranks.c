/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Places nodes over the ranks of MPI_COMM_WORLD. Prints the hash and one word with the outcome of
 * the run and the statistics of the elements (quality, edge length over d), which do not depend on
 * the number of ranks.
 * usage: place_on_ranks CASE SCALE [key=value]...
 * CASE is one of graded-square, uniform-square, jump-square, ring, or a .poly file (graded). */
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>
#include <stdio.h>
#include <stdlib.h>

#include "placement_cases.h"

static pnpbs_context context;

static void check(pnpbs_status status, const char* what) { case_check(context, status, what); }

/* Appends the number in hexadecimal, with all bits. */
static void append(char* word, double value) { sprintf(word + strlen(word), "%a/", value); }

static void describe_elements(pnpbs_placement placement, char* word) {
  const char* keys[] = {"quality.mean",      "quality.one_percent", "quality.min",
                        "quality.min_angle", "quality.irregular",   "edge.mean",
                        "edge.deviation",    "cell.mean_offset",    "cell.max_offset"};
  const char* measures[] = {"edge_ratio", "area_ratio", "dual_offset"};
  const char* counts[] = {"quality.obtuse", "edge.uncrossed"};
  double from[8], to[8], mean[8], deviation[8], value;
  int64_t edges[8], bands, b, count;
  size_t k;
  for (k = 0; k < sizeof keys / sizeof keys[0]; ++k) {
    check(pnpbs_placement_get_double(placement, keys[k], &value), keys[k]);
    append(word, value);
  }
  for (k = 0; k < sizeof counts / sizeof counts[0]; ++k) {
    check(pnpbs_placement_get_int64(placement, counts[k], &count), counts[k]);
    append(word, (double)count);
  }
  check(pnpbs_placement_get_edge_bands(placement, 8, &bands, from, to, edges, mean, deviation),
        "bands");
  for (b = 0; b < bands; ++b) {
    append(word, from[b]);
    append(word, to[b]);
    append(word, (double)edges[b]);
    append(word, mean[b]);
    append(word, deviation[b]);
  }
  for (k = 0; k < sizeof measures / sizeof measures[0]; ++k) {
    check(pnpbs_placement_get_cell_bands(placement, measures[k], 8, &bands, from, to, edges, mean,
                                         deviation),
          measures[k]);
    for (b = 0; b < bands; ++b) {
      append(word, (double)edges[b]);
      append(word, mean[b]);
      append(word, deviation[b]);
    }
  }
}

int main(int argc, char** argv) {
  struct case_spacing spacing;
  double seconds, imbalance;
  const char* hash;
  pnpbs_placement placement;
  int64_t nodes, held, steps, inserted, deleted, rebalances;
  pnpbs_status outcome;
  char elements[8192];
  int rank, size;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  check(pnpbs_context_create_mpi(MPI_COMM_WORLD, &context), "context");
  placement = case_placement(context, argv[1], atof(argv[2]), argc - 3, argv + 3, &spacing);
  outcome = pnpbs_placement_run(placement);
  check(outcome, "run");
  check(pnpbs_placement_check(placement), "check of the results");
  check(pnpbs_placement_get_int64(placement, "nodes", &nodes), "nodes");
  check(pnpbs_placement_get_int64(placement, "steps", &steps), "steps");
  check(pnpbs_placement_get_int64(placement, "inserted", &inserted), "inserted");
  check(pnpbs_placement_get_int64(placement, "deleted", &deleted), "deleted");
  check(pnpbs_placement_get_int64(placement, "nodes_held", &held), "nodes_held");
  check(pnpbs_placement_get_int64(placement, "rebalances", &rebalances), "rebalances");
  check(pnpbs_placement_get_double(placement, "imbalance", &imbalance), "imbalance");
  check(pnpbs_placement_get_double(placement, "seconds.total", &seconds), "seconds");
  sprintf(elements, "%d/", (int)outcome);
  describe_elements(placement, elements);
  check(pnpbs_placement_get_string(placement, "hash", &hash), "hash");
  if (rank == 0)
    printf(
        "hash %s nodes %lld held %lld steps %lld inserted %lld deleted %lld rebalances %lld "
        "imbalance %.3f seconds %.3f ranks %d elements %s\n",
        hash, (long long)nodes, (long long)held, (long long)steps, (long long)inserted,
        (long long)deleted, (long long)rebalances, imbalance, seconds, size, elements);
  pnpbs_placement_destroy(&placement);
  pnpbs_context_destroy(&context);
  MPI_Finalize();
  return 0;
}
