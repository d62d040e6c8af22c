/* SPDX-License-Identifier: BSD-3-Clause
 *
 * d on spheres by values on grids: against the functions that the values are of, where grids begin
 * and end and at poles, too; what is said of grids that cover a part, and of wrong ones.
 */
#include "api_support.h"

static const double R = 6371.22;

/* The whole sphere, projected from there. */
static job globe_from(double longitude, double latitude) {
  const double degrees[2] = {longitude, latitude};
  double outside[3];
  job it = {0};
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_sphere_points(1, 1, degrees, outside));
  MUST(pnpbs_domain_create_sphere(it.context, R, outside, &it.domain));
  job_place(&it);
  return it;
}

static const char* warning_with(pnpbs_placement placement, const char* part) {
  const char* text = "";
  int32_t count = 0, k;
  MUST(pnpbs_placement_warning_count(placement, &count));
  for (k = 0; k < count; ++k) {
    MUST(pnpbs_placement_get_warning(placement, k, &text));
    if (strstr(text, part)) return text;
  }
  return NULL;
}

static int64_t nodes_of(pnpbs_placement placement, double** x, double** d) {
  int64_t n;
  MUST(pnpbs_placement_count(placement, &n));
  *x = malloc((size_t)n * 3 * sizeof **x);
  *d = malloc((size_t)n * sizeof **d);
  ck_assert(*x && *d);
  MUST(pnpbs_placement_get_nodes(placement, n, *x, NULL, NULL, *d));
  return n;
}

/* ---------------------------------------------------------------- grids ------------------ */

/* Functions of longitude and latitude in degrees. */
typedef double (*field)(double longitude, double latitude);

static double to_the_poles(double longitude, double latitude) {
  (void)longitude;
  return 300 + 150 * pow(sin(PI * latitude / 180), 2);
}

/* Steepest along 180 degrees, and smooth at the poles. */
static double sideways(double longitude, double latitude) {
  return 350 + 100 * cos(PI * latitude / 180) * sin(PI * longitude / 180);
}

static int32_t field_callback(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  int64_t i;
  for (i = 0; i < n; ++i) {
    double degrees[2];
    if (pnpbs_sphere_degrees(1, x + dim * i, degrees) < 0) return 1;
    d[i] = (*(field*)user)(degrees[0], degrees[1]);
  }
  return 0;
}

typedef struct {
  int64_t size[2];
  double origin[2], step[2];
} degree_grid;

static double* values_on(const degree_grid* grid, field f) {
  double* values = malloc((size_t)(grid->size[0] * grid->size[1]) * sizeof *values);
  int64_t i, j;
  ck_assert(values);
  for (j = 0; j < grid->size[1]; ++j)
    for (i = 0; i < grid->size[0]; ++i)
      values[j * grid->size[0] + i] = f(grid->origin[0] + (double)i * grid->step[0],
                                        grid->origin[1] + (double)j * grid->step[1]);
  return values;
}

static void set_grid(pnpbs_placement placement, const degree_grid* grid, field f) {
  double* values = values_on(grid, f);
  MUST(pnpbs_placement_set_spacing_grid(placement, grid->size, grid->origin, grid->step, values));
  free(values);
}

/* Points of grids, middles of their cells, with the first column at the end again, with another
 * origin, with a last step that is shorter, without the poles: around the point that is projected
 * from, beside the meridian where the grid begins and at the poles d is the function but for what
 * is between lines through points of it, step^2 / 8 times its curvature in each direction. */
START_TEST(a_grid_around_the_sphere) {
  static const degree_grid grids[] = {
      {{72, 37}, {-180, -90}, {5, 5}},
      {{72, 36}, {-177.5, -87.5}, {5, 5}},
      {{73, 37}, {0, -90}, {5, 5}},
      {{72, 36}, {182.5, -87.5}, {5, 5}},
      {{52, 35}, {-180, -85}, {7, 5}},
      {{360, 181}, {-180, -90}, {1, 1}},
      {{1081, 542}, {-180, -90}, {1 / 3.0, 0.3327}},
  };
  const degree_grid* grid = grids + _i;
  static const double from[2][2] = {{179, -3}, {30, 88}};
  int which;
  for (which = 0; which < 2; ++which) {
    const field f = which == 0 ? sideways : to_the_poles;
    const double curvature = which == 0 ? 100 : 300;
    const double most =
        curvature / 8 *
        (pow(PI * grid->step[0] / 180, 2) * (which == 0) + pow(PI * grid->step[1] / 180, 2));
    job it = globe_from(from[which][0], from[which][1]);
    double *x, *d;
    int64_t n, i, at_seam = 0, at_poles = 0;
    set_grid(it.placement, grid, f);
    MUST_COMPUTE(pnpbs_placement_run(it.placement));
    ck_assert(!warning_with(it.placement, "covers only"));
    n = nodes_of(it.placement, &x, &d);
    for (i = 0; i < n; ++i) {
      double degrees[2], spare = most;
      MUST(pnpbs_sphere_degrees(1, x + 3 * i, degrees));
      /* The pole has the values of the last row. */
      if (fabs(degrees[1]) > -grid->origin[1]) spare += f(0, 90) - f(0, grid->origin[1]);
      ck_assert_msg(fabs(d[i] - f(degrees[0], degrees[1])) <= spare,
                    "d is %.9g at longitude %.9g, latitude %.9g, not %.9g with %.3g to spare", d[i],
                    degrees[0], degrees[1], f(degrees[0], degrees[1]), spare);
      at_seam += fabs(degrees[0]) > 178;
      at_poles += fabs(degrees[1]) > 86;
    }
    ck_assert_int_gt(at_seam, 20);
    ck_assert_int_gt(at_poles, 2);
    free(x);
    free(d);
    job_end(&it);
  }
}
END_TEST

START_TEST(a_grid_has_as_many_nodes_as_its_function) {
  static const degree_grid grid = {{180, 91}, {-180, -90}, {2, 2}};
  field f = to_the_poles;
  job by_grid = globe_from(20, -30), by_function = globe_from(20, -30);
  int64_t nodes, expected;
  set_grid(by_grid.placement, &grid, f);
  MUST(pnpbs_placement_set_spacing_callback(by_function.placement, field_callback, &f));
  MUST(pnpbs_placement_run(by_grid.placement));
  MUST(pnpbs_placement_run(by_function.placement));
  MUST(pnpbs_placement_count(by_grid.placement, &nodes));
  MUST(pnpbs_placement_count(by_function.placement, &expected));
  ck_assert_double_eq_tol((double)nodes / (double)expected, 1, 0.005);
  job_end(&by_grid);
  job_end(&by_function);
}
END_TEST

/* Rows that have different values at a pole mean one there: their mean. */
START_TEST(a_pole_has_one_spacing) {
  const int64_t size[2] = {4, 3};
  const double origin[2] = {0, -90}, step[2] = {90, 90},
               values[12] = {250, 350, 450, 350, 400, 400, 400, 400, 600, 300, 300, 400};
  job it = globe_from(20, -30);
  double *x, *d;
  int64_t n, i;
  MUST(pnpbs_placement_set_spacing_grid(it.placement, size, origin, step, values));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  n = nodes_of(it.placement, &x, &d);
  for (i = 0; i < n; ++i) {
    double degrees[2], part;
    MUST(pnpbs_sphere_degrees(1, x + 3 * i, degrees));
    part = degrees[1] / 90;
    ck_assert_double_eq_tol(d[i], part < 0 ? 400 + 50 * part : 400, 1e-9);
  }
  free(x);
  free(d);
  job_end(&it);
}
END_TEST

/* How many nodes the warning says are beyond the grid, over all. */
static double share_beyond(const char* warning) {
  long all = 0, beyond = 0;
  ck_assert_ptr_nonnull(warning);
  ck_assert_ptr_nonnull(strstr(warning, "one of them at (longitude "));
  ck_assert_int_eq(sscanf(warning,
                          "the grid of the spacing covers only a part of the domain: of %ld nodes, "
                          "%ld are farther than d from it",
                          &all, &beyond),
                   2);
  return (double)beyond / (double)all;
}

/* Constant in latitude beyond. Nodes are counted before they move. */
START_TEST(a_grid_of_some_latitudes) {
  static const degree_grid band = {{36, 13}, {-180, -60}, {10, 10}};
  job it = globe_from(20, -30);
  double *x, *d, expected;
  int64_t n, i, outside = 0;
  set_grid(it.placement, &band, to_the_poles);
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  n = nodes_of(it.placement, &x, &d);
  for (i = 0; i < n; ++i) {
    double degrees[2];
    MUST(pnpbs_sphere_degrees(1, x + 3 * i, degrees));
    outside += R * PI / 180 * (fabs(degrees[1]) - 65) > d[i];
    if (fabs(degrees[1]) > 60) ck_assert_double_eq_tol(d[i], 412.5, 1e-9);
  }
  expected = (double)outside / (double)n;
  ck_assert_double_eq_tol(
      share_beyond(warning_with(it.placement, "The grid reaches from latitude -65 to latitude 65")),
      expected, 0.02);
  free(x);
  free(d);
  job_end(&it);
}
END_TEST

/* Along the sphere, from a half of a great circle between the poles. */
static double distance_to_meridian(const double* x, double longitude) {
  double least = 2 * R;
  int k;
  for (k = -180; k <= 180; ++k) {
    const double degrees[2] = {longitude, k / 2.0};
    double y[3];
    MUST(pnpbs_sphere_points(R, 1, degrees, y));
    least = fmin(least, sqrt(pow(x[0] - y[0], 2) + pow(x[1] - y[1], 2) + pow(x[2] - y[2], 2)));
  }
  return 2 * R * asin(least / (2 * R));
}

/* Beyond, the nearer end in longitude counts. */
START_TEST(a_grid_of_some_longitudes) {
  static const degree_grid sector = {{13, 19}, {120, -90}, {10, 10}};
  job it = globe_from(20, -30);
  double *x, *d, expected;
  int64_t n, i, outside = 0;
  set_grid(it.placement, &sector, sideways);
  MUST(pnpbs_placement_set_double(it.placement, "growth_limit", 0));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  n = nodes_of(it.placement, &x, &d);
  for (i = 0; i < n; ++i) {
    double degrees[2], nearest;
    MUST(pnpbs_sphere_degrees(1, x + 3 * i, degrees));
    if (degrees[0] >= 120 || degrees[0] <= -120) continue;
    nearest = degrees[0] < 0 ? -120 : 120;
    if (fabs(degrees[1]) < 80) ck_assert_double_eq_tol(d[i], sideways(nearest, degrees[1]), 0.4);
    outside +=
        degrees[0] > -115 && degrees[0] < 115 &&
        fmin(distance_to_meridian(x + 3 * i, 115), distance_to_meridian(x + 3 * i, 245)) > d[i];
  }
  expected = (double)outside / (double)n;
  ck_assert_double_eq_tol(
      share_beyond(warning_with(it.placement,
                                "The grid reaches from longitude 115, latitude -90 to longitude "
                                "245, latitude 90")),
      expected, 0.02);
  free(x);
  free(d);
  job_end(&it);
}
END_TEST

START_TEST(wrong_grids) {
  static const struct {
    degree_grid grid;
    pnpbs_status status;
    const char *argument, *expected;
  } wrong[] = {
      {{{0, 4}, {0, 0}, {10, 10}}, PNPBS_ERROR_ARGUMENT, "size[0] = 0", "1 .. 2^31"},
      {{{4, 4}, {0, 0}, {10, -1}}, PNPBS_ERROR_ARGUMENT, "step[1] = -1", "greater than 0"},
      {{{4, 4}, {0, 0}, {NAN, 1}}, PNPBS_ERROR_ARGUMENT, "step[0] = nan", "greater than 0"},
      {{{4, 4}, {4000, 0}, {1, 1}}, PNPBS_ERROR_ARGUMENT, "origin[0] = 4000", "longitude"},
      {{{4, 4}, {0, -91}, {1, 1}}, PNPBS_ERROR_ARGUMENT, "origin[1] = -91", "-90 to 90"},
      {{{4, 4}, {0, 100}, {1, 1}}, PNPBS_ERROR_ARGUMENT, "origin[1] = 100", "-90 to 90"},
      {{{4, 4}, {0, 80}, {1, 5}},
       PNPBS_ERROR_ARGUMENT,
       "size[1] = 4: the last latitude is 95",
       "90 degrees at most"},
      {{{5, 4}, {0, 0}, {100, 1}}, PNPBS_ERROR_ARGUMENT, "size[0] = 5", "are 400 degrees"},
  };
  static const degree_grid closed = {{5, 3}, {-180, -90}, {90, 90}};
  job it = globe_from(20, -30);
  double* values;
  int k;
  for (k = 0; k < COUNT_OF(wrong); ++k) {
    const degree_grid* grid = &wrong[k].grid;
    double some[20];
    int i;
    for (i = 0; i < 20; ++i) some[i] = 300;
    MUST_FAIL(
        wrong[k].status,
        pnpbs_placement_set_spacing_grid(it.placement, grid->size, grid->origin, grid->step, some),
        wrong[k].argument, wrong[k].expected);
  }
  values = values_on(&closed, to_the_poles);
  values[7] = -2;
  MUST_FAIL(PNPBS_ERROR_SPACING,
            pnpbs_placement_set_spacing_grid(it.placement, closed.size, closed.origin, closed.step,
                                             values),
            "argument values[1][2] = -2 at longitude 0, latitude 0", "greater than 0");
  values[7] = NAN;
  MUST_FAIL(PNPBS_ERROR_SPACING,
            pnpbs_placement_set_spacing_grid(it.placement, closed.size, closed.origin, closed.step,
                                             values),
            "argument values[1][2] = nan at longitude 0, latitude 0", "finite");
  values[7] = values[5] = 300, values[9] = 310;
  MUST_FAIL(PNPBS_ERROR_SPACING,
            pnpbs_placement_set_spacing_grid(it.placement, closed.size, closed.origin, closed.step,
                                             values),
            "argument values[1][0] = 300 and argument values[1][4] = 310 are both at longitude "
            "-180, latitude 0",
            "a place has one spacing");
  free(values);
  job_end(&it);
}
END_TEST

int main(void) {
  Suite* suite = suite_create("sphere_fields");
  TCase* grids = tcase_create("grids");
  tcase_add_loop_test(grids, a_grid_around_the_sphere, 0, 7);
  tcase_add_test(grids, a_grid_has_as_many_nodes_as_its_function);
  tcase_add_test(grids, a_pole_has_one_spacing);
  tcase_add_test(grids, a_grid_of_some_latitudes);
  tcase_add_test(grids, a_grid_of_some_longitudes);
  tcase_add_test(grids, wrong_grids);
  tcase_set_timeout(grids, 0);
  suite_add_tcase(suite, grids);
  return run_suite(suite);
}
