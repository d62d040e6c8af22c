/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests fields transferred to other nodes over ranks, with first and second order. Linear or
 * quadratic fields are exact, smooth fields converge with second or third order, nodes that stay
 * keep their values, and integrals are conserved on request. The results have the bits of one
 * process. An error on one rank is an error on all. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "transfer_program.h"

static int order;

static int message_has(const char* text) { return strstr(pnpbs_last_error(context), text) != NULL; }

/* ---------------------------------------------------------------- nodes ------------------ */

typedef enum { SQUARE, DISC, CUBE, CUBE_SURFACE, SHAPES } shape;

static int dimension_of(shape s) { return s == SQUARE || s == DISC ? 2 : 3; }

static int32_t graded(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  int64_t i;
  for (i = 0; i < n; ++i) d[i] = *(const double*)user * (0.6 + 0.8 * x[dim * i + dim - 1]);
  return 0;
}

static pnpbs_placement placed(shape s, double d) {
  const double square[] = {0, 0, 1, 0, 1, 1, 0, 1}, low[] = {0, 0, 0}, high[] = {1, 1, 1},
               centre[] = {0.5, 0.5};
  pnpbs_domain domain;
  pnpbs_placement placement;
  expect(pnpbs_domain_create(context, dimension_of(s), &domain) == PNPBS_OK, "domain");
  if (s == SQUARE) pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square, NULL, 0);
  if (s == DISC) pnpbs_domain_add_arc(domain, PNPBS_BOUNDARY, centre, 0.5, 0, 2 * acos(-1.0), 1);
  if (dimension_of(s) == 3) pnpbs_domain_add_box(domain, low, high, 1);
  if (s == CUBE_SURFACE) pnpbs_domain_set_filled(domain, 0);
  expect(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  pnpbs_placement_set_int64(placement, "steps", 15);
  pnpbs_placement_set_spacing_constant(placement, d);
  expect(pnpbs_placement_run(placement) >= 0, "run");
  pnpbs_domain_destroy(&domain);
  return placement;
}

static void run_with(pnpbs_placement placement, double d) {
  expect(pnpbs_placement_set_spacing_constant(placement, d) == PNPBS_OK, "spacing");
  expect(pnpbs_placement_run(placement) >= 0, "run again");
}

/* ---------------------------------------------------------------- fields ----------------- */

enum { CONSTANT, LINEAR, QUADRATIC, SMOOTH, FIELDS };

static double field(int which, const double* x, int dim) {
  const double z = dim == 3 ? x[2] : 0.25;
  if (which == CONSTANT) return 1 / 3.0;
  if (which == LINEAR) return 2.5 * x[0] - 1.25 * x[1] + 0.75 * z - 10;
  if (which == QUADRATIC)
    return 1 + x[0] - z + 2 * x[0] * x[0] - 1.5 * x[0] * x[1] + 0.5 * x[1] * x[1] + x[0] * z -
           3 * x[1] * z + z * z;
  return sin(3 * x[0] + 0.5) * exp(x[1]) + z * z;
}

static double* field_at(const double* x, int64_t n, int dim) {
  double* values = array(FIELDS * n, sizeof(double));
  int64_t i;
  int which;
  for (i = 0; i < n; ++i)
    for (which = 0; which < FIELDS; ++which)
      values[FIELDS * i + which] = field(which, x + dim * i, dim);
  return values;
}

/* Returns the expected number of nodes with linear reconstruction: none except on surfaces. */
static int64_t expected_linear(pnpbs_placement placement, shape s) {
  int64_t nodes;
  pnpbs_placement_get_int64(placement, "nodes", &nodes);
  return s == CUBE_SURFACE ? nodes : 0;
}

static pnpbs_transfer transfer_of(pnpbs_placement placement, shape s) {
  struct nodes v = get_nodes(placement);
  double* values = field_at(v.x, v.n, v.dim);
  pnpbs_transfer transfer;
  int32_t dim, components, told;
  int64_t linear;
  expect((order == 1 ? pnpbs_transfer_create : pnpbs_transfer_create_second_order)(
             placement, v.n, FIELDS, values, &transfer) == PNPBS_OK,
         "create");
  expect(pnpbs_transfer_order(transfer, &told, &linear) == PNPBS_OK && told == order, "order");
  expect(order == 1 ? linear == -1 : linear == expected_linear(placement, s), "linear nodes");
  expect(pnpbs_transfer_sizes(transfer, &dim, &components) == PNPBS_OK && dim == v.dim &&
             components == FIELDS,
         "sizes");
  free(values), free_nodes(&v);
  return transfer;
}

/* Returns the largest error of a field over all ranks. */
static double largest_error(const double* values, const double* x, int64_t n, int dim, int which) {
  double part = 0, largest;
  int64_t i;
  for (i = 0; i < n; ++i)
    part = fmax(part, fabs(values[FIELDS * i + which] - field(which, x + dim * i, dim)));
  MPI_Allreduce(&part, &largest, 1, MPI_DOUBLE, MPI_MAX, group);
  return largest;
}

static double mean_square_error(pnpbs_placement placement, const double* values) {
  struct nodes v = get_nodes(placement);
  double *errors = array(v.n, sizeof(double)), square;
  int64_t i, all;
  for (i = 0; i < v.n; ++i)
    errors[i] = values[FIELDS * i + SMOOTH] - field(SMOOTH, v.x + v.dim * i, v.dim);
  expect(pnpbs_placement_dot(placement, v.n, 1, errors, errors, &square) == PNPBS_OK, "dot");
  pnpbs_placement_get_int64(placement, "nodes", &all);
  free(errors), free_nodes(&v);
  return sqrt(square / (double)all);
}

static void expect_exact(pnpbs_transfer transfer, pnpbs_placement placement, shape s) {
  struct nodes v = get_nodes(placement);
  double* values = at_nodes(transfer, placement, 0);
  expect(largest_error(values, v.x, v.n, v.dim, CONSTANT) < 1e-15, "a constant field");
  expect(largest_error(values, v.x, v.n, v.dim, LINEAR) < 5e-13, "a linear field");
  if (order == 2 && s != CUBE_SURFACE)
    expect(largest_error(values, v.x, v.n, v.dim, QUADRATIC) < 2e-12, "a quadratic field");
  free(values), free_nodes(&v);
}

/* ---------------------------------------------------------------- tests ------------------ */

/* Checks that the transfer is exact after rebalancing, to coarser, finer and graded nodes. */
static void check_exactness(shape s, double d) {
  pnpbs_placement placement = placed(s, d);
  pnpbs_transfer transfer = transfer_of(placement, s);
  struct nodes v;
  double *values, *right;
  expect(pnpbs_placement_rebalance(placement) == PNPBS_OK, "rebalance");
  v = get_nodes(placement);
  values = at_nodes(transfer, placement, 0);
  right = field_at(v.x, v.n, v.dim);
  expect(memcmp(values, right, (size_t)(FIELDS * v.n) * sizeof(double)) == 0,
         "nodes that stay keep their values to the bit");
  free(values), free(right), free_nodes(&v);
  run_with(placement, 1.4 * d);
  expect_exact(transfer, placement, s);
  run_with(placement, 0.7 * d);
  expect_exact(transfer, placement, s);
  expect(pnpbs_placement_set_spacing_callback(placement, graded, &d) == PNPBS_OK, "spacing");
  expect(pnpbs_placement_run(placement) >= 0, "graded");
  expect_exact(transfer, placement, s);
  pnpbs_transfer_destroy(&transfer);
  expect(transfer == NULL, "destroyed");
  pnpbs_placement_destroy(&placement);
}

/* Checks the order of convergence: halving the previous spacing reduces the error to a quarter, and
 * with second order to an eighth. */
static void check_order(shape s, double d) {
  pnpbs_placement placement = placed(s, d);
  pnpbs_transfer coarse = transfer_of(placement, s), fine;
  double *values, error[2];
  run_with(placement, d / 2);
  fine = transfer_of(placement, s);
  pnpbs_placement_destroy(&placement);
  placement = placed(s, 0.83 * d); /* the source placement may be destroyed before */
  values = at_nodes(coarse, placement, 0);
  error[0] = mean_square_error(placement, values);
  free(values);
  values = at_nodes(fine, placement, 0);
  error[1] = mean_square_error(placement, values);
  free(values);
  if (rank == 0) printf("shape %d, order %d: %g, %g\n", (int)s, order, error[0], error[1]);
  expect(error[0] > (order == 1 ? 3 : 6) * error[1], "order");
  expect(error[0] < (order == 1 ? 2 * d * d : 3 * d * d * d), "a small error");
  pnpbs_transfer_destroy(&coarse);
  pnpbs_transfer_destroy(&fine);
  pnpbs_placement_destroy(&placement);
}

static double det(const double* a, const double* b, const double* c, const double* d) {
  double m[3][3];
  int k;
  for (k = 0; k < 3; ++k) m[0][k] = b[k] - a[k], m[1][k] = c[k] - a[k], m[2][k] = d[k] - a[k];
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* Integrates the linear interpolant of a field over the elements that the library returns. `values`
 * are at the nodes of this rank. */
static void integrate(pnpbs_placement placement, const double* values, double* integrals) {
  int32_t dim;
  int64_t owned, ghosts, elements, e, *corners;
  double *x, *all, part[FIELDS] = {0};
  int k, which;
  pnpbs_placement_dimension(placement, &dim);
  pnpbs_placement_count(placement, &owned);
  pnpbs_placement_ghost_count(placement, &ghosts);
  x = array(dim * (owned + ghosts), sizeof(double));
  all = array(FIELDS * (owned + ghosts), sizeof(double));
  pnpbs_placement_get_nodes(placement, owned, x, NULL, NULL, NULL);
  pnpbs_placement_get_ghosts(placement, ghosts, x + dim * owned, NULL, NULL, NULL, NULL);
  if (owned > 0) memcpy(all, values, (size_t)(FIELDS * owned) * sizeof(double));
  expect(pnpbs_placement_update_ghosts(placement, owned + ghosts, FIELDS, all) == PNPBS_OK,
         "ghosts");
  if (dim == 2)
    pnpbs_placement_get_triangles(placement, 0, &elements, NULL);
  else
    pnpbs_placement_get_tetrahedra(placement, 0, &elements, NULL);
  corners = array((dim + 1) * elements, sizeof(int64_t));
  if (dim == 2)
    pnpbs_placement_get_triangles(placement, elements, &elements, corners);
  else
    pnpbs_placement_get_tetrahedra(placement, elements, &elements, corners);
  for (e = 0; e < elements; ++e) {
    const int64_t* c = corners + (dim + 1) * e;
    const double *p = x + dim * c[0], *q = x + dim * c[1], *r = x + dim * c[2];
    const double volume = dim == 2
                              ? ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / 2
                              : det(p, q, r, x + dim * c[3]) / 6;
    for (which = 0; which < FIELDS; ++which)
      for (k = 0; k <= dim; ++k) part[which] += volume * all[FIELDS * c[k] + which] / (dim + 1);
  }
  MPI_Allreduce(part, integrals, FIELDS, MPI_DOUBLE, MPI_SUM, group);
  free(x), free(all), free(corners);
}

static void check_integrals(shape s, double d) {
  pnpbs_placement placement = placed(s, d);
  pnpbs_transfer transfer = transfer_of(placement, s);
  struct nodes v = get_nodes(placement);
  double *values = field_at(v.x, v.n, v.dim), before[FIELDS], after[FIELDS], free_of[FIELDS];
  int which;
  integrate(placement, values, before);
  free(values), free_nodes(&v);
  run_with(placement, 1.5 * d);
  values = at_nodes(transfer, placement, 0);
  integrate(placement, values, free_of);
  free(values);
  values = at_nodes(transfer, placement, 1);
  integrate(placement, values, after);
  for (which = 0; which < FIELDS; ++which)
    expect(fabs(after[which] - before[which]) < 1e-13 * (1 + fabs(before[which])),
           "the integral is what it was");
  expect(fabs(free_of[SMOOTH] - before[SMOOTH]) > 1e-8, "without being told so it changes");
  v = get_nodes(placement);
  if (s != DISC)
    expect(largest_error(values, v.x, v.n, v.dim, LINEAR) < 5e-13,
           "a linear field stays what it is");
  expect(largest_error(values, v.x, v.n, v.dim, SMOOTH) < 8 * d * d,
         "a smooth field changes little");
  free(values), free_nodes(&v);
  pnpbs_transfer_destroy(&transfer);
  pnpbs_placement_destroy(&placement);
}

/* Computes hashes of all values after a change of d, with and without conserved integrals. */
static void hashes(shape s, double d, uint64_t found[2]) {
  pnpbs_placement placement = placed(s, d);
  pnpbs_transfer transfer = transfer_of(placement, s);
  int conserve;
  run_with(placement, 0.8 * d);
  for (conserve = 0; conserve < 2; ++conserve) {
    struct nodes v = get_nodes(placement);
    double* values = at_nodes(transfer, placement, conserve);
    found[conserve] = hash_of(&v, FIELDS, values);
    free(values), free_nodes(&v);
  }
  pnpbs_transfer_destroy(&transfer);
  pnpbs_placement_destroy(&placement);
}

static void check_same_bits(shape s, double d) {
  uint64_t part[2], together[2], alone[2];
  pnpbs_context all = context;
  hashes(s, d, part);
  MPI_Allreduce(part, together, 2, MPI_UINT64_T, MPI_SUM, group);
  expect(pnpbs_context_create_serial(&context) == PNPBS_OK, "serial context");
  if (rank == 0) {
    hashes(s, d, alone);
    expect(memcmp(together, alone, sizeof alone) == 0, "other values than one process has");
  }
  expect(together[0] != together[1], "the integral made a difference");
  pnpbs_context_destroy(&context);
  context = all;
}

/* Checks values at points inside and slightly outside of the domain. The first rank has no points.
 */
static void check_points(shape s, double d) {
  pnpbs_placement placement = placed(s, d);
  pnpbs_transfer transfer = transfer_of(placement, s);
  const int dim = dimension_of(s);
  const int64_t n = rank == 0 && size > 1 ? 0 : 200;
  double *x = array(dim * n, sizeof(double)), *values = array(FIELDS * n, sizeof(double));
  int64_t i;
  for (i = 0; i < dim * n; ++i) x[i] = 1.06 * fmod(0.618034 * (double)(i + 1 + 7 * rank), 1) - 0.03;
  expect(pnpbs_transfer_at_points(transfer, n, x, values) == PNPBS_OK, "points");
  expect(largest_error(values, x, n, dim, CONSTANT) < 1e-15, "a constant field at points");
  expect(largest_error(values, x, n, dim, LINEAR) < 5e-12, "a linear field at points");
  if (order == 2)
    expect(largest_error(values, x, n, dim, QUADRATIC) < 5e-12, "a quadratic field at points");
  expect(largest_error(values, x, n, dim, SMOOTH) < 60 * d * d, "a smooth field at points");
  if (rank == size - 1) x[dim * 3] = NAN;
  expect(pnpbs_transfer_at_points(transfer, n, x, values) == PNPBS_ERROR_ARGUMENT &&
             message_has("coordinates[3][0] is nan"),
         "a point that is nowhere");
  free(x), free(values);
  pnpbs_transfer_destroy(&transfer);
  pnpbs_placement_destroy(&placement);
}

static void check_errors(void) {
  pnpbs_placement placement = placed(SQUARE, 0.1), cube = placed(CUBE, 0.5);
  pnpbs_transfer transfer = NULL;
  struct nodes v = get_nodes(placement);
  double* values = field_at(v.x, v.n, v.dim);
  char id[60] = "";
  const int last = rank == size - 1;
  int64_t n;
  if (last) {
    snprintf(id, sizeof id, "component 1 at node %lld is nan", (long long)v.ids[v.n / 2]);
    values[FIELDS * (v.n / 2) + 1] = NAN;
  }
  MPI_Bcast(id, sizeof id, MPI_CHAR, size - 1, group);
  expect(pnpbs_transfer_create(placement, v.n, FIELDS, values, &transfer) == PNPBS_ERROR_ARGUMENT &&
             message_has(id) && transfer == NULL,
         "no number at a node");
  if (last) values[FIELDS * (v.n / 2) + 1] = 0;
  expect(pnpbs_transfer_create(placement, v.n - last, FIELDS, values, &transfer) ==
                 PNPBS_ERROR_ARGUMENT &&
             message_has("argument n = "),
         "a value missing on one rank");
  expect(pnpbs_transfer_create(placement, v.n, FIELDS, last ? NULL : values, &transfer) ==
                 PNPBS_ERROR_ARGUMENT &&
             message_has("values is NULL"),
         "no values on one rank");
  expect(pnpbs_transfer_create(placement, v.n, FIELDS - FIELDS * last, values, &transfer) ==
                 PNPBS_ERROR_ARGUMENT &&
             message_has("components = 0"),
         "no component on one rank");
  if (size > 1)
    expect(pnpbs_transfer_create(placement, v.n, FIELDS - last, values, &transfer) ==
                   PNPBS_ERROR_ARGUMENT &&
               message_has("all ranks must give the same"),
           "other components on one rank");
  if (size > 1)
    expect((last ? pnpbs_transfer_create : pnpbs_transfer_create_second_order)(
               placement, v.n, FIELDS, values, &transfer) == PNPBS_ERROR_ARGUMENT &&
               message_has("same order"),
           "another order on one rank");
  expect(pnpbs_transfer_create(placement, v.n, FIELDS, values, &transfer) == PNPBS_OK, "create");
  expect(
      pnpbs_transfer_at_nodes(transfer, placement, 0, v.n - last, values) == PNPBS_ERROR_CAPACITY,
      "too little room on one rank");
  pnpbs_placement_count(cube, &n);
  expect(pnpbs_transfer_at_nodes(transfer, cube, 0, n, values) == PNPBS_ERROR_ARGUMENT &&
             message_has("dimensions"),
         "nodes in another dimension");
  pnpbs_placement_destroy(&cube);
  expect(pnpbs_transfer_at_nodes(transfer, placement, 1, v.n, values) == PNPBS_OK,
         "it goes on afterwards");
  pnpbs_transfer_destroy(&transfer);
  free(values), free_nodes(&v);
  pnpbs_placement_destroy(&placement);
}

static void check_all(void) {
  const double d[SHAPES] = {0.1, 0.1, 0.28, 0.25};
  shape s;
  for (order = 1; order <= 2; ++order)
    for (s = SQUARE; s < SHAPES; ++s) {
      check_exactness(s, d[s]);
      check_same_bits(s, d[s]);
      if (s == CUBE_SURFACE) continue;
      check_order(s, 1.2 * d[s]);
      check_integrals(s, d[s]);
      check_points(s, d[s]);
    }
  check_errors();
}

int main(int argc, char** argv) { return run_in_groups(argc, argv, check_all); }
