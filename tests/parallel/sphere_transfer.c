/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests fields transferred from previous nodes on a sphere over ranks: the order of accuracy, also
 * about the centre of projection; conserved integrals; and the bits of one process. */
#include <math.h>
#include <stdlib.h>

#include "transfer_program.h"

static const double R = 6371.22, kPoint[2] = {20, -30}; /* kPoint is the centre of projection */
enum { CONSTANT, SMOOTH, FIELDS };
enum { GLOBE, SEA, SHAPES, CAP = SHAPES };

static int order;

/* ---------------------------------------------------------------- nodes ------------------ */

static int32_t finer_north(int64_t n, int32_t dim, const double* x, double* d, void* finest) {
  int64_t i;
  (void)dim;
  for (i = 0; i < n; ++i) d[i] = *(const double*)finest * (1.5 - 0.5 * x[3 * i + 2] / R);
  return 0;
}

static void run_with(pnpbs_placement placement, double d) {
  pnpbs_placement_set_spacing_callback(placement, finer_north, &d);
  expect(pnpbs_placement_run(placement) >= 0, "run");
}

/* Returns a placement on the globe, in the sea or in the cap. The sea lies about the south pole, up
 * to 30 degrees north; the cap is its southernmost part. */
static pnpbs_placement placed(int shape, double d) {
  const double north[2] = {0, 90};
  double outside[3], degrees[2 * 90], coast[3 * 90];
  pnpbs_domain domain;
  pnpbs_placement placement;
  int k;
  pnpbs_sphere_points(1, 1, shape == GLOBE ? kPoint : north, outside);
  expect(pnpbs_domain_create_sphere(context, R, outside, &domain) == PNPBS_OK, "domain");
  if (shape != GLOBE) {
    const double latitude = shape == SEA ? 30 : -70;
    for (k = 0; k < 90; ++k)
      degrees[2 * k] = 4 * k, degrees[2 * k + 1] = latitude + 5 * sin(0.2 * k);
    pnpbs_sphere_points(R, 90, degrees, coast);
    expect(pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 90, coast, NULL, 40) == PNPBS_OK,
           "coast");
  }
  expect(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  pnpbs_domain_destroy(&domain);
  run_with(placement, d);
  return placement;
}

/* ---------------------------------------------------------------- fields ----------------- */

static double field(int which, const double* x) {
  return which == CONSTANT ? 1 / 3.0 : sin(2 * x[0] / R + 0.5) * exp(x[1] / R) + x[2] / R;
}

static double* field_at(const double* x, int64_t n) {
  double* values = array(FIELDS * n, sizeof(double));
  int64_t i;
  int which;
  for (i = 0; i < n; ++i)
    for (which = 0; which < FIELDS; ++which) values[FIELDS * i + which] = field(which, x + 3 * i);
  return values;
}

static pnpbs_transfer transfer_of(pnpbs_placement placement) {
  struct nodes v = get_nodes(placement);
  double* values = field_at(v.x, v.n);
  pnpbs_transfer transfer;
  int64_t linear;
  expect((order == 1 ? pnpbs_transfer_create : pnpbs_transfer_create_second_order)(
             placement, v.n, FIELDS, values, &transfer) == PNPBS_OK,
         "create");
  expect(
      pnpbs_transfer_order(transfer, NULL, &linear) == PNPBS_OK && linear == (order == 1 ? -1 : 0),
      "linear nodes");
  free(values), free_nodes(&v);
  return transfer;
}

/* ---------------------------------------------------------------- order ------------------ */

/* Returns the largest error over all ranks, at points that do not depend on the nodes and lie
 * within 30 degrees of the centre of projection. */
static double error_about_the_point(pnpbs_transfer transfer) {
  enum { N = 2000 };
  double *degrees = array(2 * N, sizeof(double)), *x = array(3 * N, sizeof(double));
  double *values = array(FIELDS * N, sizeof(double)), largest = 0;
  int i;
  for (i = 0; i < N; ++i) {
    const double way = 30 * sqrt((i + 0.5) / N), angle = 2.399963 * i;
    degrees[2 * i] = kPoint[0] + way * cos(angle),
                degrees[2 * i + 1] = kPoint[1] + way * sin(angle);
  }
  pnpbs_sphere_points(2 * R, N, degrees, x); /* points on the rays are allowed */
  expect(pnpbs_transfer_at_points(transfer, N, x, values) == PNPBS_OK, "at points");
  for (i = 0; i < N; ++i) {
    const double on_sphere[3] = {x[3 * i] / 2, x[3 * i + 1] / 2, x[3 * i + 2] / 2};
    expect(fabs(values[FIELDS * i] - 1 / 3.0) < 1e-15, "a constant field");
    largest = fmax(largest, fabs(values[FIELDS * i + SMOOTH] - field(SMOOTH, on_sphere)));
  }
  free(degrees), free(x), free(values);
  return largest;
}

/* Checks that the extrapolation stays bounded far beyond the cap, where the field is unknown. */
static void check_is_bounded(void) {
  enum { N = 40 };
  pnpbs_placement placement = placed(CAP, 200);
  pnpbs_transfer transfer = transfer_of(placement);
  double degrees[2 * N], x[3 * N], values[FIELDS * N];
  int i;
  for (i = 0; i < N; ++i) degrees[2 * i] = 37 * i, degrees[2 * i + 1] = -70 + 160.0 * i / (N - 1);
  pnpbs_sphere_points(R, N, degrees, x);
  expect(pnpbs_transfer_at_points(transfer, N, x, values) == PNPBS_OK, "at points far away");
  for (i = 0; i < N; ++i) expect(fabs(values[FIELDS * i + SMOOTH]) < 15, "a bounded field");
  pnpbs_transfer_destroy(&transfer);
  pnpbs_placement_destroy(&placement);
}

static void check_order(int shape) {
  double error[2];
  int k;
  for (k = 0; k < 2; ++k) {
    pnpbs_placement placement = placed(shape, k == 0 ? 600 : 300);
    pnpbs_transfer transfer = transfer_of(placement);
    pnpbs_placement_destroy(&placement);
    error[k] = error_about_the_point(transfer);
    pnpbs_transfer_destroy(&transfer);
  }
  if (rank == 0) printf("shape %d, order %d: %g, %g\n", shape, order, error[0], error[1]);
  expect(error[0] > (order == 1 ? 3 : 6) * error[1], "order");
  expect(error[0] < (order == 1 ? 0.02 : 0.01), "a small error");
}

/* ---------------------------------------------------------------- integrals -------------- */

static double arc(const double* a, const double* b) {
  const double u = a[0] - b[0], v = a[1] - b[1], w = a[2] - b[2];
  return 2 * asin(sqrt(u * u + v * v + w * w) / (2 * R));
}

/* Returns the area along the sphere, by l'Huilier's theorem. */
static double area(const double* a, const double* b, const double* c) {
  const double u = arc(b, c), v = arc(c, a), w = arc(a, b), s = (u + v + w) / 2;
  return 4 * R * R *
         atan(sqrt(tan(s / 2) * tan((s - u) / 2) * tan((s - v) / 2) * tan((s - w) / 2)));
}

static void integrate(pnpbs_placement placement, const double* values, double* integrals) {
  int64_t owned, ghosts, triangles, t, *corners;
  double *x, *all, part[FIELDS] = {0};
  int which;
  pnpbs_placement_count(placement, &owned);
  pnpbs_placement_ghost_count(placement, &ghosts);
  x = array(3 * (owned + ghosts), sizeof(double));
  all = array(FIELDS * (owned + ghosts), sizeof(double));
  pnpbs_placement_get_nodes(placement, owned, x, NULL, NULL, NULL);
  pnpbs_placement_get_ghosts(placement, ghosts, x + 3 * owned, NULL, NULL, NULL, NULL);
  if (owned > 0) memcpy(all, values, (size_t)(FIELDS * owned) * sizeof(double));
  expect(pnpbs_placement_update_ghosts(placement, owned + ghosts, FIELDS, all) == PNPBS_OK,
         "ghosts");
  pnpbs_placement_get_triangles(placement, 0, &triangles, NULL);
  corners = array(3 * triangles, sizeof(int64_t));
  pnpbs_placement_get_triangles(placement, triangles, &triangles, corners);
  for (t = 0; t < triangles; ++t) {
    const int64_t *c = corners + 3 * t, a = c[0], b = c[1], e = c[2];
    const double third = area(x + 3 * a, x + 3 * b, x + 3 * e) / 3;
    for (which = 0; which < FIELDS; ++which)
      part[which] +=
          third * (all[FIELDS * a + which] + all[FIELDS * b + which] + all[FIELDS * e + which]);
  }
  MPI_Allreduce(part, integrals, FIELDS, MPI_DOUBLE, MPI_SUM, group);
  free(x), free(all), free(corners);
}

static void check_integrals(int shape) {
  pnpbs_placement placement = placed(shape, 500);
  pnpbs_transfer transfer = transfer_of(placement);
  struct nodes v = get_nodes(placement);
  double *values = field_at(v.x, v.n), before[FIELDS], after[FIELDS], free_of[FIELDS];
  int which;
  integrate(placement, values, before);
  free(values);
  values = at_nodes(transfer, placement, 0);
  for (which = 0; which < FIELDS * v.n; ++which)
    expect(values[which] == field(which % FIELDS, v.x + 3 * (which / FIELDS)),
           "a node keeps its value");
  free(values), free_nodes(&v);
  run_with(placement, 700);
  values = at_nodes(transfer, placement, 0);
  integrate(placement, values, free_of);
  free(values);
  values = at_nodes(transfer, placement, 1);
  integrate(placement, values, after);
  for (which = 0; which < FIELDS; ++which)
    expect(fabs(after[which] - before[which]) < 1e-12 * R * R, "the integral is what it was");
  expect(fabs(free_of[SMOOTH] - before[SMOOTH]) > 1e-5 * R * R, "without being told so it changes");
  v = get_nodes(placement);
  for (which = 0; which < v.n; ++which)
    expect(fabs(values[FIELDS * which + SMOOTH] - field(SMOOTH, v.x + 3 * which)) < 0.04,
           "a smooth field changes little");
  free(values), free_nodes(&v);
  pnpbs_transfer_destroy(&transfer);
  pnpbs_placement_destroy(&placement);
}

/* ---------------------------------------------------------------- spheres ---------------- */

/* Transfers from the globe to a sea with another centre of projection. */
static void check_another_point(void) {
  pnpbs_placement globe = placed(GLOBE, 500), sea = placed(SEA, 500);
  pnpbs_transfer transfer = transfer_of(globe);
  struct nodes v = get_nodes(sea);
  double* values = at_nodes(transfer, sea, 0);
  int64_t i;
  for (i = 0; i < v.n; ++i) {
    expect(fabs(values[FIELDS * i] - 1 / 3.0) < 1e-15, "a constant field on a sea");
    expect(fabs(values[FIELDS * i + SMOOTH] - field(SMOOTH, v.x + 3 * i)) < 0.03,
           "a smooth field on a sea");
  }
  free(values), free_nodes(&v);
  pnpbs_transfer_destroy(&transfer);
  pnpbs_placement_destroy(&sea);
  pnpbs_placement_destroy(&globe);
}

static void check_another_radius(void) {
  const double outside[3] = {0, 0, 1};
  double value;
  pnpbs_placement globe = placed(GLOBE, 700), larger;
  pnpbs_transfer transfer = transfer_of(globe);
  pnpbs_domain domain;
  pnpbs_domain_create_sphere(context, 1.001 * R, outside, &domain);
  pnpbs_placement_create(context, domain, &larger);
  pnpbs_domain_destroy(&domain);
  pnpbs_placement_set_spacing_constant(larger, 1000);
  expect(pnpbs_placement_initialise(larger) >= 0, "a larger sphere");
  expect(pnpbs_transfer_at_nodes(transfer, larger, 0, 1, &value) == PNPBS_ERROR_ARGUMENT,
         "another radius is refused");
  pnpbs_transfer_destroy(&transfer);
  pnpbs_placement_destroy(&larger);
  pnpbs_placement_destroy(&globe);
}

/* ---------------------------------------------------------------- bits ------------------- */

static uint64_t hash_after_a_change(int shape) {
  pnpbs_placement placement = placed(shape, 500);
  pnpbs_transfer transfer = transfer_of(placement);
  struct nodes v;
  double* values;
  uint64_t hash;
  run_with(placement, 400);
  v = get_nodes(placement);
  values = at_nodes(transfer, placement, 1);
  hash = hash_of(&v, FIELDS, values);
  free(values), free_nodes(&v);
  pnpbs_transfer_destroy(&transfer);
  pnpbs_placement_destroy(&placement);
  return hash;
}

static void check_same_bits(int shape) {
  const uint64_t part = hash_after_a_change(shape);
  uint64_t together;
  pnpbs_context all = context;
  MPI_Allreduce(&part, &together, 1, MPI_UINT64_T, MPI_SUM, group);
  expect(pnpbs_context_create_serial(&context) == PNPBS_OK, "serial context");
  if (rank == 0)
    expect(together == hash_after_a_change(shape), "other values than one process has");
  pnpbs_context_destroy(&context);
  context = all;
}

static void check_all(void) {
  int shape;
  for (order = 1; order <= 2; ++order) {
    check_is_bounded();
    for (shape = GLOBE; shape < SHAPES; ++shape) {
      check_order(shape);
      check_integrals(shape);
      if (order == 2) check_same_bits(shape); /* the second order includes the first */
    }
  }
  order = 1;
  check_another_point();
  check_another_radius();
}

int main(int argc, char** argv) { return run_in_groups(argc, argv, check_all); }
