/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests fields of a solver over ranks, in the plane and in space. Ghosts receive the values of
 * their owners, in one call or while the solver computes. Sums and dot products are exact and have
 * the bits of one process. An error on one rank is an error on all, and no rank hangs. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rank_program.h"

static int message_has(const char* text) { return strstr(pnpbs_last_error(context), text) != NULL; }

static void* array(int64_t n, size_t of) { return calloc((size_t)n + 1, of); }

/* This rank's nodes, then its ghosts. */
struct nodes {
  int32_t dim;
  int64_t owned, all, *ids;
  double* x;
};

static struct nodes get_nodes(pnpbs_placement placement) {
  struct nodes v;
  int64_t ghosts;
  pnpbs_placement_dimension(placement, &v.dim);
  pnpbs_placement_count(placement, &v.owned);
  expect(pnpbs_placement_ghost_count(placement, &ghosts) == PNPBS_OK, "ghosts");
  v.all = v.owned + ghosts;
  v.ids = array(v.all, sizeof(int64_t));
  v.x = array(v.dim * v.all, sizeof(double));
  pnpbs_placement_get_nodes(placement, v.owned, v.x, v.ids, NULL, NULL);
  expect(pnpbs_placement_get_ghosts(placement, ghosts, v.x + v.dim * v.owned, v.ids + v.owned, NULL,
                                    NULL, NULL) == PNPBS_OK,
         "ghosts");
  return v;
}

static void free_nodes(struct nodes* v) { free(v->ids), free(v->x); }

static pnpbs_placement placed(int32_t dim) {
  pnpbs_domain domain = unit_domain(dim);
  pnpbs_placement placement;
  expect(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  pnpbs_placement_set_int64(placement, "steps", 20);
  pnpbs_placement_set_spacing_constant(placement, dim == 2 ? 0.05 : 0.2);
  expect(pnpbs_placement_run(placement) >= 0, "run");
  pnpbs_domain_destroy(&domain);
  return placement;
}

/* ---------------------------------------------------------------- ghosts ----------------- */

/* Returns a value that is unique to a node, in each component. */
static double mark(const struct nodes* v, int64_t i, int c) {
  return c == 0 ? (double)v->ids[i] : v->x[v->dim * i] * c + v->x[v->dim * i + 1];
}

static double* marked(const struct nodes* v, int components, int64_t n) {
  double* values = array(v->all * components, sizeof(double));
  int64_t i;
  int c;
  for (i = 0; i < v->all; ++i)
    for (c = 0; c < components; ++c) values[i * components + c] = i < n ? mark(v, i, c) : -7;
  return values;
}

static void check_update(pnpbs_placement placement, const struct nodes* v, int components) {
  const size_t bytes = (size_t)(v->all * components) * sizeof(double);
  double *values = marked(v, components, v->owned), *right = marked(v, components, v->all);
  expect(pnpbs_placement_update_ghosts(placement, v->all, components, values) == PNPBS_OK,
         "update");
  expect(memcmp(values, right, bytes) == 0, "a ghost has another value than its node");
  free(values);

  /* The values at the time of the begin call are sent, and other calls may follow before the end
   * call. */
  values = marked(v, components, v->owned);
  expect(pnpbs_placement_begin_update_ghosts(placement, v->all, components, values) == PNPBS_OK,
         "begin");
  memset(values, 0, (size_t)(v->owned * components) * sizeof(double));
  expect(pnpbs_placement_sum(placement, v->all, components, right, right) == PNPBS_OK,
         "a sum while an update is under way");
  free(right);
  right = marked(v, components, v->all);
  memset(right, 0, (size_t)(v->owned * components) * sizeof(double));
  expect(pnpbs_placement_end_update_ghosts(placement, v->all, components, values) == PNPBS_OK,
         "end");
  expect(memcmp(values, right, bytes) == 0, "a ghost has another value than its node had");
  free(values), free(right);
}

static void check_wrong_updates(pnpbs_placement placement, const struct nodes* v) {
  const int last = rank == size - 1;
  double* values = marked(v, 2, v->owned);
  expect(pnpbs_placement_end_update_ghosts(placement, v->all, 1, values) == PNPBS_ERROR_STATE,
         "nothing to end");
  expect(pnpbs_placement_update_ghosts(placement, v->all - last, 1, values) == PNPBS_ERROR_ARGUMENT,
         "a value missing on one rank");
  expect(message_has("argument n = "), "n is named");
  expect(pnpbs_placement_update_ghosts(placement, v->all, 1 - last, values) == PNPBS_ERROR_ARGUMENT,
         "no component on one rank");
  expect(message_has("components = 0"), "components are named");
  expect(pnpbs_placement_begin_update_ghosts(placement, v->all, 1, last ? NULL : values) ==
             PNPBS_ERROR_ARGUMENT,
         "no values on one rank");
  expect(message_has("values is NULL"), "values are named");
  if (size > 1)
    expect(pnpbs_placement_update_ghosts(placement, v->all, 1 + last, values) ==
                   PNPBS_ERROR_ARGUMENT &&
               message_has("all ranks must give the same"),
           "other components on one rank");
  expect(pnpbs_placement_begin_update_ghosts(placement, v->all, 2, values) == PNPBS_OK, "begin");
  expect(pnpbs_placement_begin_update_ghosts(placement, v->all, 2, values) == PNPBS_ERROR_STATE,
         "a second one");
  expect(pnpbs_placement_update_ghosts(placement, v->all, 2, values) == PNPBS_ERROR_STATE,
         "another one between");
  if (last) {
    expect(pnpbs_placement_end_update_ghosts(placement, v->all, 1, values) == PNPBS_ERROR_ARGUMENT,
           "it began with two");
    expect(
        pnpbs_placement_end_update_ghosts(placement, v->all + 1, 2, values) == PNPBS_ERROR_ARGUMENT,
        "too many values");
  }
  expect(pnpbs_placement_end_update_ghosts(placement, v->all, 2, values) == PNPBS_OK,
         "it ends all the same");
  free(values);
}

/* Checks that an update in progress becomes invalid if nodes move or change owners. */
static void check_moving(pnpbs_placement placement) {
  struct nodes v = get_nodes(placement);
  double* values = marked(&v, 1, v.owned);
  expect(pnpbs_placement_begin_update_ghosts(placement, v.all, 1, values) == PNPBS_OK, "begin");
  expect(pnpbs_placement_step(placement, 1) >= 0, "a step between");
  expect(pnpbs_placement_end_update_ghosts(placement, v.all, 1, values) == PNPBS_ERROR_STATE,
         "the nodes are no longer there");
  free(values), free_nodes(&v);
  v = get_nodes(placement);
  check_update(placement, &v, 1);
  /* An update that is never ended causes no error in later calls. */
  values = marked(&v, 1, v.owned);
  expect(pnpbs_placement_begin_update_ghosts(placement, v.all, 1, values) == PNPBS_OK, "begin");
  free(values), free_nodes(&v);
}

/* ---------------------------------------------------------------- sums ------------------- */

/* Returns a value by the global number of the node: large terms that cancel, and 1. Any sum that
 * rounds intermediate results, in any order, is wrong by more than 2^100 with high probability. */
static double ill_conditioned(int64_t number, int64_t all) {
  const int64_t pair = (number - 1) / 2;
  if (number == 0) return 1;
  if (number == all - 1 && all % 2 == 0) return 0; /* has no partner */
  return (number % 2 == 0 ? -1 : 1) * ldexp((double)(1 + pair % 7), (int)(100 + pair * 37 % 800));
}

static void check_known_sums(pnpbs_placement placement, const struct nodes* v) {
  double *values = array(2 * v->all, sizeof(double)), *ones = array(2 * v->all, sizeof(double));
  double sums[2], squares[2];
  int64_t first, all, i;
  pnpbs_placement_get_int64(placement, "nodes", &all);
  pnpbs_placement_get_numbering(placement, 0, &first, NULL, NULL);
  for (i = 0; i < v->all; ++i) {
    values[2 * i] = i < v->owned ? ill_conditioned(first + i, all) : NAN; /* ghosts do not count */
    values[2 * i + 1] = i < v->owned ? ldexp((double)(first + i), -1070) : NAN;
    ones[2 * i] = ones[2 * i + 1] = 1;
  }
  expect(pnpbs_placement_sum(placement, v->all, 2, values, sums) == PNPBS_OK, "sums");
  expect(sums[0] == 1, "an ill-conditioned sum");
  expect(sums[1] == ldexp((double)(all * (all - 1) / 2), -1070), "a sum of the smallest numbers");
  expect(pnpbs_placement_dot(placement, v->owned, 2, values, ones, sums) == PNPBS_OK, "products");
  expect(sums[0] == 1, "an ill-conditioned dot product");
  for (i = 0; i < v->owned; ++i) {
    values[2 * i] = ldexp((double)(first + i), 1000);
    values[2 * i + 1] = ldexp(1, -1000);
    ones[2 * i] = ldexp(1, -1000);
    ones[2 * i + 1] = first + i == all / 2 ? INFINITY : -1;
  }
  expect(pnpbs_placement_dot(placement, v->all, 2, values, ones, squares) == PNPBS_OK, "products");
  expect(squares[0] == (double)(all * (all - 1) / 2) && squares[1] == INFINITY, "products");
  values[0] = rank == 0 ? NAN : 0;
  expect(pnpbs_placement_sum(placement, v->owned, 2, values, sums) == PNPBS_OK, "sums");
  expect(isnan(sums[0]) && sums[1] == ldexp((double)all, -1000), "a component that is no number");

  if (v->owned > 0 && rank == size - 1) {
    expect(pnpbs_placement_sum(placement, v->owned - 1, 2, values, sums) == PNPBS_ERROR_ARGUMENT,
           "too few");
  } else {
    expect(pnpbs_placement_sum(placement, v->owned, 2, values, sums) == PNPBS_ERROR_ARGUMENT,
           "too few on another rank");
  }
  expect(pnpbs_placement_dot(placement, v->owned, 2, values, rank == 0 ? NULL : ones, sums) ==
                 PNPBS_ERROR_ARGUMENT &&
             message_has("argument y is NULL"),
         "nothing to multiply with on one rank");
  free(values), free(ones);
}

/* Computes sums of a field, on all ranks or on one process. */
static void some_sums(pnpbs_placement placement, double sums[6]) {
  struct nodes v = get_nodes(placement);
  double *f = array(3 * v.owned, sizeof(double)), *g = array(3 * v.owned, sizeof(double));
  int64_t i;
  int c;
  for (i = 0; i < v.owned; ++i)
    for (c = 0; c < 3; ++c) {
      f[3 * i + c] = sin(mark(&v, i, c + 1)) * 1e6 / (c + 1);
      g[3 * i + c] = cos(7 * v.x[v.dim * i] - c);
    }
  expect(pnpbs_placement_sum(placement, v.owned, 3, f, sums) == PNPBS_OK, "sums");
  expect(pnpbs_placement_dot(placement, v.owned, 3, f, g, sums + 3) == PNPBS_OK, "products");
  free(f), free(g), free_nodes(&v);
}

static void check_same_bits(pnpbs_placement placement, int32_t dim) {
  double together[6], alone[6];
  pnpbs_context all = context;
  some_sums(placement, together);
  pnpbs_placement_rebalance(placement);
  some_sums(placement, alone);
  expect(memcmp(together, alone, sizeof alone) == 0, "other sums with other owners");
  expect(pnpbs_context_create_serial(&context) == PNPBS_OK, "serial context");
  if (rank == 0) {
    placement = placed(dim);
    some_sums(placement, alone);
    expect(memcmp(together, alone, sizeof alone) == 0, "other sums than one process has");
    pnpbs_placement_destroy(&placement);
  }
  pnpbs_context_destroy(&context);
  context = all;
}

static void check(int32_t dim) {
  pnpbs_placement placement = placed(dim);
  struct nodes v = get_nodes(placement);
  int64_t ghosts = v.all - v.owned, all;
  MPI_Allreduce(&ghosts, &all, 1, MPI_INT64_T, MPI_SUM, group);
  expect(size == 1 ? all == 0 : all > 0, "there are ghosts to test");
  check_update(placement, &v, 1);
  check_update(placement, &v, 5);
  check_wrong_updates(placement, &v);
  check_known_sums(placement, &v);
  free_nodes(&v);
  check_same_bits(placement, dim);
  check_moving(placement);
  pnpbs_placement_destroy(&placement);
}

static void check_without_nodes(void) {
  pnpbs_domain domain;
  pnpbs_placement placement;
  double value = 0;
  pnpbs_domain_create(context, 2, &domain);
  pnpbs_placement_create(context, domain, &placement);
  expect(pnpbs_placement_update_ghosts(placement, 0, 1, &value) == PNPBS_ERROR_STATE, "no nodes");
  expect(pnpbs_placement_sum(placement, 0, 1, &value, &value) == PNPBS_ERROR_STATE, "no nodes");
  pnpbs_placement_destroy(&placement);
  pnpbs_domain_destroy(&domain);
}

static void check_all(void) {
  check_without_nodes();
  check(2);
  check(3);
}

int main(int argc, char** argv) { return run_in_groups(argc, argv, check_all); }
