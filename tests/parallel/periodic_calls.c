/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests calls on placements in periodic domains over ranks: their results are those of a single
 * rank, bit for bit. */
#define _POSIX_C_SOURCE 200809L /* mkdtemp */
#include <math.h>
#include <stdlib.h>
#include <unistd.h>

#include "rank_program.h"

enum { MAX_DIM = 3, MAX_NAME = 100 };
static const double low[MAX_DIM] = {-0.3, 0.2, 1}, high[MAX_DIM] = {0.7, 1.5, 1.9};
static const double turn = 6.283185307179586;

typedef struct {
  const char* name;
  int32_t dim, periodic[MAX_DIM];
  double d;
  int hole; /* over a corner */
} domain_case;

static const domain_case cases[] = {
    {"torus", 2, {1, 1}, 0.05, 0},
    {"hole", 2, {1, 1}, 0.05, 1},
    {"layer", 3, {1, 1, 0}, 0.12, 0},
};
static pnpbs_context alone; /* the context of the reference */
static char path[MAX_NAME];
static const char* case_name;

static void expect_of_case(int condition, const char* what) {
  char text[2 * MAX_NAME];
  snprintf(text, sizeof text, "%s: %s", case_name, what);
  expect(condition, text);
}

static pnpbs_placement new_placement(pnpbs_context on, const domain_case* it, double longer) {
  double end[MAX_DIM];
  pnpbs_domain domain;
  pnpbs_placement placement;
  memcpy(end, high, sizeof end);
  end[1] += longer;
  expect_of_case(pnpbs_domain_create(on, it->dim, &domain) == PNPBS_OK, "domain");
  expect_of_case(pnpbs_domain_set_periodic(domain, low, end, it->periodic, NULL) == PNPBS_OK,
                 "periodic");
  if (it->hole)
    expect_of_case(pnpbs_domain_add_arc(domain, PNPBS_BOUNDARY, end, 0.25, 0, turn, 1) == PNPBS_OK,
                   "hole");
  expect_of_case(pnpbs_placement_create(on, domain, &placement) == PNPBS_OK, "placement");
  pnpbs_placement_set_spacing_constant(placement, it->d);
  return placement;
}

static void expect_same_nodes(pnpbs_placement placement, pnpbs_placement reference,
                              const char* what) {
  char here[32], expected[32];
  hash_of_nodes(placement, here);
  hash_of_nodes(reference, expected);
  expect_of_case(strcmp(here, expected) == 0, what);
}

static void get_nodes(pnpbs_placement placement, int32_t dim, int64_t* count, double** x,
                      int64_t** ids, double** d) {
  pnpbs_placement_count(placement, count);
  *x = calloc((size_t)(*count * dim + 1), sizeof **x);
  *ids = calloc((size_t)*count + 1, sizeof **ids);
  *d = calloc((size_t)*count + 1, sizeof **d);
  expect_of_case(pnpbs_placement_get_nodes(placement, *count, *x, *ids, NULL, *d) == PNPBS_OK,
                 "nodes");
}

/* ---------------------------------------------------------------- sums over ranks ------- */

/* Returns a hash of an id and of values, whose sum over all ranks is compared. */
static uint64_t hash_of(int64_t id, int64_t n, const double* values) {
  uint64_t h = (uint64_t)id * 0x9E3779B97F4A7C15u;
  int64_t k;
  for (k = 0; k < n; ++k) {
    uint64_t bits;
    memcpy(&bits, values + k, sizeof bits);
    h = (h ^ bits) * 0xBF58476D1CE4E5B9u;
    h ^= h >> 29;
  }
  return h;
}

/* Expects that the sum of `here` over the ranks is that of the reference, which each rank has. */
static void expect_same_sum(uint64_t here, uint64_t reference, const char* what) {
  uint64_t sum;
  MPI_Allreduce(&here, &sum, 1, MPI_UINT64_T, MPI_SUM, group);
  expect_of_case(sum == reference, what);
}

/* ---------------------------------------------------------------- calls ----------------- */

/* Places again by values of d at the nodes. */
static void adapt(pnpbs_placement placement, const domain_case* it) {
  int64_t owned, i, *ids;
  double *x, *d;
  get_nodes(placement, it->dim, &owned, &x, &ids, &d);
  for (i = 0; i < owned; ++i)
    d[i] *= 1 + 0.1 * cos(turn * (x[it->dim * i + 1] - low[1]) / (high[1] - low[1]));
  expect_of_case(pnpbs_placement_set_spacing_at_nodes(placement, owned, d) == PNPBS_OK,
                 "d at nodes");
  expect_of_case(pnpbs_placement_run(placement) >= PNPBS_OK, "adapted");
  free(x), free(ids), free(d);
}

/* Interrupts an adapted run, and continues from the checkpoint on all ranks and on one. */
static void check_checkpoints(pnpbs_placement placement, pnpbs_placement reference,
                              const domain_case* it) {
  int on_one;
  pnpbs_placement other;
  expect_of_case(pnpbs_placement_set_spacing_constant(reference, 0.95 * it->d) == PNPBS_OK &&
                     pnpbs_placement_set_spacing_constant(placement, 0.95 * it->d) == PNPBS_OK,
                 "another d");
  adapt(placement, it);
  adapt(reference, it);
  expect_of_case(pnpbs_placement_step(placement, 7) >= 0, "steps");
  expect_of_case(pnpbs_placement_write_checkpoint(placement, path) == PNPBS_OK, "written");
  expect_of_case(pnpbs_placement_step(reference, 7) >= 0, "steps of the reference");
  expect_of_case(pnpbs_placement_run(reference) >= 0, "run of the reference");
  for (on_one = 0; on_one < 2; ++on_one) {
    other = new_placement(on_one ? alone : context, it, 0);
    expect_of_case(pnpbs_placement_read_checkpoint(other, path) == PNPBS_OK, "read");
    expect_of_case(pnpbs_placement_run(other) >= 0, "continued");
    expect_same_nodes(other, reference, "continued nodes");
    expect_of_case(pnpbs_placement_check(other) == PNPBS_OK, "continued elements");
    pnpbs_placement_destroy(&other);
  }
  other = new_placement(context, it, 0.01);
  expect_of_case(pnpbs_placement_read_checkpoint(other, path) == PNPBS_ERROR_DOMAIN,
                 "another cell");
  pnpbs_placement_destroy(&other);
}

static double wave(int32_t dim, const double* x) {
  double sum = 1;
  int32_t k;
  for (k = 0; k < dim; ++k) sum += sin(turn * (x[k] - low[k]) / (high[k] - low[k]));
  return sum;
}

/* Transfers a field of `from` to `to` and returns a hash of the values there. */
static uint64_t transferred(pnpbs_placement from, pnpbs_placement to, const domain_case* it,
                            int second) {
  int64_t n, i, *ids;
  double *x, *d, *values;
  uint64_t sum = 0;
  pnpbs_transfer transfer;
  get_nodes(from, it->dim, &n, &x, &ids, &d);
  for (i = 0; i < n; ++i) d[i] = wave(it->dim, x + it->dim * i);
  expect_of_case((second ? pnpbs_transfer_create_second_order(from, n, 1, d, &transfer)
                         : pnpbs_transfer_create(from, n, 1, d, &transfer)) == PNPBS_OK,
                 "transfer");
  free(x), free(ids), free(d);
  get_nodes(to, it->dim, &n, &x, &ids, &d);
  values = calloc((size_t)n + 1, sizeof *values);
  expect_of_case(pnpbs_transfer_at_nodes(transfer, to, 1, n, values) == PNPBS_OK, "at nodes");
  for (i = 0; i < n; ++i) {
    const double error = values[i] - wave(it->dim, x + it->dim * i);
    expect_of_case(fabs(error) < (it->dim == 2 ? 0.03 : 0.25), "error of a transfer");
    sum += hash_of(ids[i], 1, values + i);
  }
  pnpbs_transfer_destroy(&transfer);
  free(x), free(ids), free(d), free(values);
  return sum;
}

/* Combines the hashes of the mid nodes by their numbers: equal ones of several images of an edge
 * stay as they are. Returns the number of mid nodes of this rank that are images of others. */
static int64_t mid_nodes(pnpbs_placement placement, const domain_case* it, int64_t all,
                         uint64_t* hashes) {
  int64_t count, ghosts, edges, i, k, images = 0;
  int64_t *ends, *numbers;
  double *x, *midpoints;
  pnpbs_placement_count(placement, &count);
  expect_of_case(pnpbs_placement_ghost_count(placement, &ghosts) == PNPBS_OK, "ghosts");
  expect_of_case(
      pnpbs_placement_get_edges(placement, 0, &edges, NULL, NULL, NULL, NULL) == PNPBS_OK, "edges");
  x = calloc((size_t)((count + ghosts) * it->dim + 1), sizeof *x);
  ends = calloc((size_t)(2 * edges + 1), sizeof *ends);
  numbers = calloc((size_t)edges + 1, sizeof *numbers);
  midpoints = calloc((size_t)(it->dim * edges + 1), sizeof *midpoints);
  pnpbs_placement_get_nodes(placement, count, x, NULL, NULL, NULL);
  pnpbs_placement_get_ghosts(placement, ghosts, x + count * it->dim, NULL, NULL, NULL, NULL);
  expect_of_case(pnpbs_placement_get_edges(placement, edges, &edges, NULL, ends, numbers,
                                           midpoints) == PNPBS_OK,
                 "edges");
  for (i = 0; i < edges; ++i) {
    double far = 0, half = 0, inside[MAX_DIM];
    for (k = 0; k < it->dim; ++k) {
      const double a = x[it->dim * ends[2 * i] + k], b = x[it->dim * ends[2 * i + 1] + k];
      const double middle = midpoints[it->dim * i + k];
      far += (middle - (a + b) / 2) * (middle - (a + b) / 2);
      half += (b - a) * (b - a) / 4;
      inside[k] = middle;
      if (it->periodic[k] && middle < low[k]) inside[k] += high[k] - low[k];
      if (it->periodic[k] && middle >= high[k]) inside[k] -= high[k] - low[k];
    }
    expect_of_case(far < 0.05 * half, "middle of an edge");
    expect_of_case(numbers[i] >= 0 && numbers[i] < all, "number of an edge");
    images += hashes[numbers[i]] != 0;
    hashes[numbers[i]] |= hash_of(numbers[i] + 1, it->dim, inside);
  }
  free(x), free(ends), free(numbers), free(midpoints);
  return images;
}

static void check_mid_nodes(pnpbs_placement placement, pnpbs_placement reference,
                            const domain_case* it) {
  int64_t nodes, edges, images, i;
  uint64_t *here, *expected;
  pnpbs_placement_count(reference, &nodes);
  pnpbs_placement_get_edges(reference, 0, &edges, NULL, NULL, NULL, NULL);
  here = calloc((size_t)edges + 1, sizeof *here);
  expected = calloc((size_t)edges + 1, sizeof *expected);
  images = mid_nodes(reference, it, edges, expected);
  expect_of_case(images > 0, "images of edges");
  edges -= images;
  if (it->hole == 0 && it->dim == 2 && it->periodic[0])
    expect_of_case(edges == 3 * nodes, "number of edges of the torus");
  mid_nodes(placement, it, edges, here);
  MPI_Allreduce(MPI_IN_PLACE, here, (int)edges, MPI_UINT64_T, MPI_BOR, group);
  for (i = 0; i < edges; ++i) expect_of_case(here[i] == expected[i] && here[i] != 0, "mid node");
  free(here), free(expected);
}

/* Gives the nodes, shifted by periods and with other ids. */
static void give_shifted(pnpbs_placement placement, pnpbs_placement from, const domain_case* it) {
  int64_t n, i, k, *ids;
  double *x, *d;
  get_nodes(from, it->dim, &n, &x, &ids, &d);
  for (i = 0; i < n; ++i) {
    for (k = 0; k < it->dim; ++k)
      if (it->periodic[k]) x[it->dim * i + k] += (double)(ids[i] % 5 - 2) * (high[k] - low[k]);
    ids[i] = 3 * ids[i] + 1;
  }
  expect_of_case(pnpbs_placement_set_nodes(placement, n, x, ids) == PNPBS_OK, "given nodes");
  expect_of_case(pnpbs_placement_run(placement) >= 0, "run from given nodes");
  free(x), free(ids), free(d);
}

static void check_case(const domain_case* it) {
  pnpbs_placement placement, other, reference, other_reference;
  case_name = it->name;
  placement = new_placement(context, it, 0), other = new_placement(context, it, 0);
  reference = new_placement(alone, it, 0), other_reference = new_placement(alone, it, 0);
  expect_of_case(pnpbs_placement_run(placement) >= 0 && pnpbs_placement_run(reference) >= 0, "run");
  check_mid_nodes(placement, reference, it);
  give_shifted(other, placement, it);
  give_shifted(other_reference, reference, it);
  expect_same_nodes(other, other_reference, "given nodes");
  expect_of_case(pnpbs_placement_check(other) == PNPBS_OK, "elements of given nodes");
  adapt(other, it);
  adapt(other_reference, it);
  expect_same_nodes(other, other_reference, "adapted nodes");
  expect_same_sum(transferred(placement, other, it, 0),
                  transferred(reference, other_reference, it, 0), "transfer");
  expect_same_sum(transferred(placement, other, it, 1),
                  transferred(reference, other_reference, it, 1), "transfer of second order");
  check_checkpoints(placement, reference, it);
  pnpbs_placement_destroy(&placement), pnpbs_placement_destroy(&reference);
  pnpbs_placement_destroy(&other), pnpbs_placement_destroy(&other_reference);
}

static void checks(void) {
  char folder[] = "/tmp/pnpbs_periodic_XXXXXX";
  size_t k;
  expect(pnpbs_context_create_serial(&alone) == PNPBS_OK, "serial context");
  if (rank == 0 && !mkdtemp(folder)) expect(0, "folder");
  MPI_Bcast(folder, sizeof folder, MPI_CHAR, 0, group);
  snprintf(path, sizeof path, "%s/state.pnpbs", folder);
  for (k = 0; k < sizeof cases / sizeof *cases; ++k) check_case(&cases[k]);
  MPI_Barrier(group);
  if (rank == 0) unlink(path), rmdir(folder);
  pnpbs_context_destroy(&alone);
}

int main(int argc, char** argv) { return run_in_groups(argc, argv, checks); }
