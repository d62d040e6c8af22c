/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Common functions of the programs that transfer fields to other nodes over ranks. */
#ifndef PNPBS_TESTS_TRANSFER_PROGRAM_H
#define PNPBS_TESTS_TRANSFER_PROGRAM_H

#include <stdlib.h>

#include "rank_program.h"

static inline void* array(int64_t n, size_t of) { return calloc((size_t)n + 1, of); }

struct nodes {
  int32_t dim;
  int64_t n, *ids;
  double* x;
};

static inline struct nodes get_nodes(pnpbs_placement placement) {
  struct nodes v;
  pnpbs_placement_dimension(placement, &v.dim);
  pnpbs_placement_count(placement, &v.n);
  v.ids = array(v.n, sizeof(int64_t));
  v.x = array(v.dim * v.n, sizeof(double));
  expect(pnpbs_placement_get_nodes(placement, v.n, v.x, v.ids, NULL, NULL) == PNPBS_OK, "nodes");
  return v;
}

static inline void free_nodes(struct nodes* v) { free(v->ids), free(v->x); }

/* Returns the transferred values as an array [nodes of this rank][components]. */
static inline double* at_nodes(pnpbs_transfer transfer, pnpbs_placement placement, int conserve) {
  int64_t n;
  int32_t components = 0;
  double* values;
  pnpbs_placement_count(placement, &n);
  pnpbs_transfer_sizes(transfer, NULL, &components);
  values = array(components * n, sizeof(double));
  expect(pnpbs_transfer_at_nodes(transfer, placement, conserve, n, values) == PNPBS_OK, "at nodes");
  return values;
}

/* Hashes this rank's values, independent of their order and owners. */
static inline uint64_t hash_of(const struct nodes* v, int components, const double* values) {
  uint64_t hash = 0, bits;
  int64_t i;
  for (i = 0; i < components * v->n; ++i) {
    memcpy(&bits, values + i, sizeof bits);
    bits = (bits ^ (uint64_t)v->ids[i / components] * 0x9e3779b97f4a7c15u) +
           (uint64_t)(i % components);
    bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9u;
    hash += (bits ^ bits >> 27) * 0x94d049bb133111ebu;
  }
  return hash;
}

#endif
