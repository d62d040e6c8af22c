/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Places nodes over the ranks of MPI_COMM_WORLD and prints the hash: the same for any number of
 * ranks. usage: place_on_ranks CASE SCALE [key=value]...  with CASE one of graded-square,
 * uniform-square, jump-square, or a .poly file (graded) */
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>
#include <stdio.h>
#include <stdlib.h>

#include "placement_cases.h"

static pnpbs_context context;

static void check(pnpbs_status status, const char* what) { case_check(context, status, what); }

int main(int argc, char** argv) {
  struct case_spacing spacing;
  double seconds, imbalance;
  const char* hash;
  pnpbs_placement placement;
  int64_t nodes, held, steps, inserted, deleted, rebalances;
  int rank, size;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  check(pnpbs_context_create_mpi(MPI_COMM_WORLD, &context), "context");
  placement = case_placement(context, argv[1], atof(argv[2]), argc - 3, argv + 3, &spacing);
  check(pnpbs_placement_run(placement), "run");
  check(pnpbs_placement_get_int64(placement, "nodes", &nodes), "nodes");
  check(pnpbs_placement_get_int64(placement, "steps", &steps), "steps");
  check(pnpbs_placement_get_int64(placement, "inserted", &inserted), "inserted");
  check(pnpbs_placement_get_int64(placement, "deleted", &deleted), "deleted");
  check(pnpbs_placement_get_int64(placement, "nodes_held", &held), "nodes_held");
  check(pnpbs_placement_get_int64(placement, "rebalances", &rebalances), "rebalances");
  check(pnpbs_placement_get_double(placement, "imbalance", &imbalance), "imbalance");
  check(pnpbs_placement_get_double(placement, "seconds.total", &seconds), "seconds");
  check(pnpbs_placement_get_string(placement, "hash", &hash), "hash");
  if (rank == 0)
    printf(
        "hash %s nodes %lld held %lld steps %lld inserted %lld deleted %lld rebalances %lld "
        "imbalance %.3f seconds %.3f ranks %d\n",
        hash, (long long)nodes, (long long)held, (long long)steps, (long long)inserted,
        (long long)deleted, (long long)rebalances, imbalance, seconds, size);
  pnpbs_placement_destroy(&placement);
  pnpbs_context_destroy(&context);
  MPI_Finalize();
  return 0;
}
