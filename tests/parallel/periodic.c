/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests periodic domains over ranks: the nodes are those of a single rank, bit for bit; images have
 * the ids and the positions of their nodes; and the exchange pattern reaches images on the same
 * rank. */
#include <math.h>
#include <stdlib.h>

#include "rank_program.h"

enum { MAX_DIM = 3 };
static const double low[MAX_DIM] = {-0.3, 0.2, 1}, high[MAX_DIM] = {0.7, 1.5, 1.9};
static const double turn = 6.283185307179586;

#ifndef CASES_APART
#define CASES_APART 1 /* sanitized code runs some of the cases only */
#endif

typedef struct {
  const char* name;
  int32_t dim, periodic[MAX_DIM];
  double d, growth; /* smallest d, and how much larger it is elsewhere */
  int hole;         /* a hole or cavity over a corner */
  int64_t interval; /* of exchanges */
} domain_case;

static const domain_case cases[] = {
    {"graded square", 2, {1, 1}, 0.015, 2, 0, 1},
    {"few exchanges", 2, {1, 1}, 0.015, 2, 0, 5},
    {"channel", 2, {0, 1}, 0.015, 2, 0, 1},
    {"hole", 2, {1, 1}, 0.015, 2, 1, 1},
    {"cube", 3, {1, 1, 1}, 0.1, 0, 0, 1},
    {"graded cube", 3, {1, 1, 1}, 0.08, 0.6, 0, 1},
    {"layer", 3, {1, 1, 0}, 0.09, 0.4, 0, 1},
    {"flat sides", 2, {PNPBS_FLAT, PNPBS_FLAT}, 0.02, 1, 1, 1},
    {"flat layer", 3, {PNPBS_FLAT, PNPBS_FLAT, 0}, 0.12, 0, 0, 1},
};

static int32_t wave(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  const domain_case* it = user;
  int64_t i;
  int32_t k;
  for (i = 0; i < n; ++i) {
    double sum = 0;
    for (k = 0; k < dim; ++k)
      sum += 1 - cos(turn * (x[dim * i + k] - low[k] - 0.1) / (high[k] - low[k]));
    d[i] = it->d * (1 + it->growth * sum / (2 * dim));
  }
  return 0;
}

static pnpbs_placement place(pnpbs_context on, const domain_case* it) {
  pnpbs_domain domain;
  pnpbs_placement placement;
  expect(pnpbs_domain_create(on, it->dim, &domain) == PNPBS_OK, "domain");
  expect(pnpbs_domain_set_periodic(domain, low, high, it->periodic, NULL) == PNPBS_OK, "periodic");
  if (it->hole)
    expect(pnpbs_domain_add_arc(domain, PNPBS_BOUNDARY, high, 0.25, 0, turn, 1) == PNPBS_OK,
           "hole");
  expect(pnpbs_placement_create(on, domain, &placement) == PNPBS_OK, "placement");
  pnpbs_placement_set_int64(placement, "exchange_interval", it->interval);
  expect(pnpbs_placement_set_spacing_callback(placement, wave, (void*)it) == PNPBS_OK, "spacing");
  expect(pnpbs_placement_run(placement) >= PNPBS_OK, it->name);
  expect(pnpbs_placement_check(placement) == PNPBS_OK, "check");
  return placement;
}

/* Expects that ghosts are images of the nodes whose values the exchange brings to them. */
static void expect_images(pnpbs_placement placement, const domain_case* it) {
  int64_t owned, ghosts, i;
  const int32_t dim = it->dim;
  double *x, *sent;
  int32_t k;
  pnpbs_placement_count(placement, &owned);
  expect(pnpbs_placement_ghost_count(placement, &ghosts) == PNPBS_OK, "ghosts");
  x = calloc((size_t)((owned + ghosts) * dim), sizeof *x);
  sent = calloc((size_t)((owned + ghosts) * dim), sizeof *sent);
  pnpbs_placement_get_nodes(placement, owned, x, NULL, NULL, NULL);
  pnpbs_placement_get_ghosts(placement, ghosts, x + owned * dim, NULL, NULL, NULL, NULL);
  memcpy(sent, x, (size_t)(owned * dim) * sizeof *sent);
  expect(pnpbs_placement_begin_update_ghosts(placement, owned + ghosts, dim, sent) == PNPBS_OK &&
             pnpbs_placement_end_update_ghosts(placement, owned + ghosts, dim, sent) == PNPBS_OK,
         "update");
  for (i = 0; i < (owned + ghosts) * dim; ++i) {
    double way;
    k = (int32_t)(i % dim);
    way = (x[i] - sent[i]) / (high[k] - low[k]);
    expect(it->periodic[k] ? fabs(way - rint(way)) < 1e-12 : way == 0, "periods of an image");
  }
  free(x), free(sent);
}

/* Expects that the file has the same bytes as that of a single rank. Rank 0 compares them. */
static void expect_same_file(pnpbs_placement placement, pnpbs_placement reference,
                             const char* extension, const char* what) {
  char path[64], alone_path[64];
  snprintf(path, sizeof path, "periodic_%d.%s", size, extension);
  snprintf(alone_path, sizeof alone_path, "periodic_%d_alone.%s", size, extension);
  expect(pnpbs_placement_write(placement, path, 1) == PNPBS_OK, what);
  if (rank == 0) {
    FILE *one, *other;
    int c = 0;
    long bytes = 0;
    expect(pnpbs_placement_write(reference, alone_path, 1) == PNPBS_OK, what);
    one = fopen(path, "rb"), other = fopen(alone_path, "rb");
    expect(one && other, path);
    if (one && other) {
      for (; (c = getc(one)) == getc(other) && c != EOF; ++bytes) continue;
      expect(c == EOF && feof(other) && bytes > 10000, path);
    }
    if (one) fclose(one);
    if (other) fclose(other);
    remove(path), remove(alone_path);
  }
  MPI_Barrier(group);
}

static void checks(void) {
  pnpbs_context alone;
  size_t k;
  expect(pnpbs_context_create_serial(&alone) == PNPBS_OK, "serial context");
  for (k = 0; k < sizeof cases / sizeof *cases; k += CASES_APART) {
    char here[32], expected[32];
    pnpbs_placement placement = place(context, &cases[k]), reference = NULL;
    hash_of_nodes(placement, here);
    if (rank == 0) {
      reference = place(alone, &cases[k]);
      hash_of_nodes(reference, expected);
      expect(strcmp(here, expected) == 0, cases[k].name);
    }
    expect_images(placement, &cases[k]);
    expect_same_file(placement, reference, "msh", cases[k].name);
    expect_same_file(placement, reference, "vtu", cases[k].name);
    pnpbs_placement_destroy(&placement);
    if (reference) pnpbs_placement_destroy(&reference);
  }
  pnpbs_context_destroy(&alone);
}

int main(int argc, char** argv) { return run_in_groups(argc, argv, checks); }
