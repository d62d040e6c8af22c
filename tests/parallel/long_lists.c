/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests adjacency lists with the largest radius, for stencils of high order, over ranks. The nodes
 * are those of shorter lists, and every list equals that of one process, in the plane and in space.
 */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "rank_program.h"

static void* array(int64_t n, size_t of) { return calloc((size_t)n + 1, of); }

static pnpbs_placement placed(int32_t dim, const char* radius) {
  double finest = dim == 2 ? 0.03 : 0.11;
  pnpbs_domain domain = unit_domain(dim);
  pnpbs_placement placement;
  expect(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  expect(pnpbs_placement_set(placement, "adjacency_radius", radius) == PNPBS_OK, "radius");
  pnpbs_placement_set_int64(placement, "steps", 20);
  pnpbs_placement_set_spacing_callback(placement, growing_spacing, &finest);
  expect(pnpbs_placement_run(placement) >= 0, "run");
  pnpbs_domain_destroy(&domain);
  return placement;
}

static uint64_t mixed(uint64_t x) {
  x = (x ^ (x >> 31)) * UINT64_C(0x9e3779b97f4a7c15);
  x = (x ^ (x >> 29)) * UINT64_C(0xbf58476d1ce4e5b9);
  return x ^ (x >> 32);
}

/* Returns a hash of all lists of all ranks, including the order in them. */
static uint64_t hash_of_lists(pnpbs_placement placement, int over_ranks, int64_t* longest) {
  int64_t n, ghosts, entries, *ids, *offsets, *neighbours, i, k;
  uint64_t hash = 0;
  pnpbs_placement_count(placement, &n);
  expect(pnpbs_placement_ghost_count(placement, &ghosts) == PNPBS_OK, "ghosts");
  expect(pnpbs_placement_adjacency_size(placement, &entries) == PNPBS_OK, "entries");
  ids = array(n + ghosts, sizeof *ids);
  offsets = array(n, sizeof *offsets);
  neighbours = array(entries, sizeof *neighbours);
  pnpbs_placement_get_nodes(placement, n, NULL, ids, NULL, NULL);
  pnpbs_placement_get_ghosts(placement, ghosts, NULL, ids + n, NULL, NULL, NULL);
  expect(pnpbs_placement_get_adjacency(placement, entries, offsets, neighbours) == PNPBS_OK,
         "lists");
  *longest = 0;
  for (i = 0; i < n; ++i) {
    uint64_t list = mixed((uint64_t)ids[i] + 1);
    for (k = offsets[i]; k < offsets[i + 1]; ++k) list = mixed(list + (uint64_t)ids[neighbours[k]]);
    hash += list;
    if (offsets[i + 1] - offsets[i] > *longest) *longest = offsets[i + 1] - offsets[i];
  }
  if (over_ranks) MPI_Allreduce(MPI_IN_PLACE, &hash, 1, MPI_UINT64_T, MPI_SUM, group);
  free(ids), free(offsets), free(neighbours);
  return hash;
}

static void check(int32_t dim) {
  pnpbs_placement longs = placed(dim, "4"), shorts = placed(dim, "1.7");
  pnpbs_context all = context;
  char hash[32], other[32];
  int64_t longest, most;
  const uint64_t together = hash_of_lists(longs, 1, &longest);
  hash_of_nodes(longs, hash);
  hash_of_nodes(shorts, other);
  expect(strcmp(hash, other) == 0, "the nodes do not depend on the radius");
  expect(pnpbs_placement_check(longs) == PNPBS_OK, "check");
  MPI_Allreduce(&longest, &most, 1, MPI_INT64_T, MPI_MAX, group);
  expect(most > (dim == 2 ? 45 : 200), "lists are long");
  pnpbs_placement_destroy(&longs);
  pnpbs_placement_destroy(&shorts);

  expect(pnpbs_context_create_serial(&context) == PNPBS_OK, "serial context");
  if (rank == 0) {
    pnpbs_placement alone = placed(dim, "4");
    expect(hash_of_lists(alone, 0, &longest) == together, "lists are those of one process");
    expect(longest == most, "and as long");
    hash_of_nodes(alone, other);
    expect(strcmp(hash, other) == 0, "nodes are those of one process");
    pnpbs_placement_destroy(&alone);
  }
  pnpbs_context_destroy(&context);
  context = all;
}

static void check_all(void) {
  check(2);
  check(3);
}

int main(int argc, char** argv) { return run_in_groups(argc, argv, check_all); }
