/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests spacings on spheres from values on grids, on meshes and at points, against the functions
 * that were sampled and against searches through all triangles. The cases include the first and
 * last columns of grids, poles and the centre of projection, fields that cover a part of the
 * sphere, and invalid input.
 */
#include "api_support.h"

static const double R = 6371.22;

/* Returns a placement on the whole sphere with this centre of projection. */
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

/* A function of longitude and latitude in degrees. */
typedef double (*field)(double longitude, double latitude);

static double to_the_poles(double longitude, double latitude) {
  (void)longitude;
  return 300 + 150 * pow(sin(PI * latitude / 180), 2);
}

/* Returns a function that is steepest along 180 degrees and smooth at the poles. */
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

/* The grids have values at corners or at the middles of cells, repeat the first column at the end,
 * have another origin, have a shorter last step, or lack the poles. At the centre of projection, at
 * the meridian where the grid begins and at the poles, d must equal the function up to the
 * interpolation error: step^2 / 8 times the curvature in each direction. */
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

/* A single low value lies in the middle of the sphere, at the meridian where the grid begins, or in
 * the row next to a pole. Samples of d miss it, and the nodes must follow it nevertheless. */
START_TEST(a_low_value_of_a_grid) {
  static const int64_t size[2] = {360, 181}, spots[3][2] = {{77, 121}, {0, 40}, {211, 179}};
  static const double origin[2] = {-180, -90}, step[2] = {1, 1};
  double* values = malloc((size_t)(size[0] * size[1]) * sizeof *values);
  double *x, *d, degrees[2], spot[3];
  int64_t n, i, near = 0;
  job it = globe_from(20, -30);
  ck_assert(values);
  for (i = 0; i < size[0] * size[1]; ++i) values[i] = 600;
  values[spots[_i][1] * size[0] + spots[_i][0]] = 15;
  MUST(pnpbs_placement_set_spacing_grid(it.placement, size, origin, step, values));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  degrees[0] = origin[0] + (double)spots[_i][0];
  degrees[1] = origin[1] + (double)spots[_i][1];
  MUST(pnpbs_sphere_points(R, 1, degrees, spot));
  n = nodes_of(it.placement, &x, &d);
  for (i = 0; i < n; ++i)
    near += hypot(hypot(x[3 * i] - spot[0], x[3 * i + 1] - spot[1]), x[3 * i + 2] - spot[2]) < 60;
  ck_assert_int_gt(near, 6);
  free(values);
  free(x);
  free(d);
  job_end(&it);
}
END_TEST

/* A row at a pole with different values gives one value there: their mean. */
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

/* The sea is 20 degrees wide, and the grid lies on the other side of the Earth. */
START_TEST(a_grid_beside_the_domain) {
  static const int64_t size[2] = {4, 4};
  static const double step[2] = {5, 5}, degrees[8] = {0, 0, 20, 0, 20, 20, 0, 20};
  double values[16], coast[12], origin[2] = {150, -40}, outside[3] = {0, 0, -1};
  job it = {0};
  int k;
  for (k = 0; k < 16; ++k) values[k] = 100;
  MUST(pnpbs_context_create_serial(&it.context));
  MUST(pnpbs_domain_create_sphere(it.context, R, outside, &it.domain));
  MUST(pnpbs_sphere_points(R, 4, degrees, coast));
  MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_BOUNDARY, 1, 4, coast, NULL, 30));
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_grid(it.placement, size, origin, step, values));
  MUST_FAIL(PNPBS_ERROR_SPACING, pnpbs_placement_initialise(it.placement),
            "the grid of the spacing does not meet the domain: all ",
            "The grid reaches from longitude 147.5");
  origin[0] = 10, origin[1] = 10;
  MUST(pnpbs_placement_set_spacing_grid(it.placement, size, origin, step, values));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  ck_assert(warning_with(it.placement, "covers only a part"));
  job_end(&it);
}
END_TEST

/* Returns the share of nodes that the warning reports as beyond the grid. */
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

/* Beyond the grid d is constant in latitude. The warning counts nodes before they move. */
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

/* Returns the distance along the sphere to a meridian, from pole to pole. */
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

/* Beyond the grid, the end that is nearer in longitude counts. */
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
            "a point has one spacing");
  free(values);
  job_end(&it);
}
END_TEST

/* ---------------------------------------------------------------- meshes and points ------ */

typedef struct {
  int64_t n, triangles;
  double *x, *d;
  int64_t* corners;
} sphere_mesh;

/* Returns the triangles of a placement, with values of a function at its nodes. */
static sphere_mesh mesh_of(pnpbs_placement placement, field f) {
  sphere_mesh mesh = {0};
  int64_t i;
  mesh.n = nodes_of(placement, &mesh.x, &mesh.d);
  MUST(pnpbs_placement_get_triangles(placement, 0, &mesh.triangles, NULL));
  mesh.corners = malloc((size_t)mesh.triangles * 3 * sizeof *mesh.corners);
  ck_assert(mesh.corners);
  MUST(pnpbs_placement_get_triangles(placement, mesh.triangles, &mesh.triangles, mesh.corners));
  for (i = 0; f && i < mesh.n; ++i) {
    double degrees[2];
    MUST(pnpbs_sphere_degrees(1, mesh.x + 3 * i, degrees));
    mesh.d[i] = f(degrees[0], degrees[1]);
  }
  return mesh;
}

static void mesh_free(sphere_mesh* mesh) {
  free(mesh->x);
  free(mesh->d);
  free(mesh->corners);
}

/* Returns the triangles of a whole sphere with this centre of projection. */
static sphere_mesh globe_mesh(double longitude, double latitude, double spacing, field f) {
  job it = globe_from(longitude, latitude);
  sphere_mesh mesh;
  MUST(pnpbs_placement_set_spacing_constant(it.placement, spacing));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  mesh = mesh_of(it.placement, f);
  job_end(&it);
  return mesh;
}

static void set_mesh(pnpbs_placement placement, const sphere_mesh* mesh) {
  MUST(pnpbs_placement_set_spacing_mesh(placement, mesh->n, mesh->x, mesh->d, mesh->triangles,
                                        mesh->corners));
}

/* Computes the value at the intersection of a triangle and the ray from the centre through x, by
 * linear interpolation (T. Moeller, B. Trumbore, J. Graphics Tools 2 (1997) 21-28). Returns whether
 * they intersect. */
static int value_on_ray(const sphere_mesh* mesh, int64_t t, const double* x, double* value) {
  const int64_t* c = mesh->corners + 3 * t;
  const double* a = mesh->x + 3 * c[0];
  double e[2][3], p[3], q[3], u, v, determinant, along;
  int k;
  for (k = 0; k < 3; ++k) {
    e[0][k] = mesh->x[3 * c[1] + k] - a[k];
    e[1][k] = mesh->x[3 * c[2] + k] - a[k];
  }
  for (k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3, m = (k + 2) % 3;
    p[k] = x[l] * e[1][m] - x[m] * e[1][l];
    q[k] = -a[l] * e[0][m] + a[m] * e[0][l];
  }
  determinant = e[0][0] * p[0] + e[0][1] * p[1] + e[0][2] * p[2];
  u = -(a[0] * p[0] + a[1] * p[1] + a[2] * p[2]) / determinant;
  v = (x[0] * q[0] + x[1] * q[1] + x[2] * q[2]) / determinant;
  along = (e[1][0] * q[0] + e[1][1] * q[1] + e[1][2] * q[2]) / determinant;
  if (u < -1e-9 || v < -1e-9 || u + v > 1 + 1e-9 || along < 0) return 0;
  *value = (1 - u - v) * mesh->d[c[0]] + u * mesh->d[c[1]] + v * mesh->d[c[2]];
  return 1;
}

/* One domain has the mesh's own centre of projection, about which the mesh's triangle is unbounded
 * in the chart; the others have other centres. Growth is not limited, so d at nodes equals the
 * values of the mesh. */
START_TEST(a_mesh_of_the_whole_sphere) {
  static const double from[3][2] = {{20, -30}, {-160, 30}, {85, 88}};
  sphere_mesh mesh = globe_mesh(20, -30, 800, sideways);
  job it = globe_from(from[_i][0], from[_i][1]);
  double *x, *d;
  int64_t n, i, t;
  set_mesh(it.placement, &mesh);
  MUST(pnpbs_placement_set_double(it.placement, "growth_limit", 0));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  ck_assert(!warning_with(it.placement, "covers only"));
  n = nodes_of(it.placement, &x, &d);
  ck_assert_int_gt(n, 3000);
  for (i = 0; i < n; ++i) {
    double expected = 0;
    for (t = 0; t < mesh.triangles && !value_on_ray(&mesh, t, x + 3 * i, &expected); ++t) continue;
    ck_assert_int_lt(t, mesh.triangles);
    ck_assert_double_eq_tol(d[i], expected, 1e-6);
  }
  free(x);
  free(d);
  mesh_free(&mesh);
  job_end(&it);
}
END_TEST

/* If d at the nodes is given back as a spacing, the number of nodes stays the same. The test uses
 * both a mesh and points, also for a d that is finest at the centre of projection. */
START_TEST(as_many_nodes_by_their_own_spacing) {
  field f = _i % 2 == 0 ? to_the_poles : sideways;
  job it = globe_from(-90, 5);
  sphere_mesh mesh;
  int64_t nodes;
  MUST(pnpbs_placement_set_spacing_callback(it.placement, field_callback, &f));
  MUST(pnpbs_placement_run(it.placement));
  mesh = mesh_of(it.placement, NULL);
  if (_i < 2)
    set_mesh(it.placement, &mesh);
  else
    MUST(pnpbs_placement_set_spacing_points(it.placement, mesh.n, mesh.x, mesh.d));
  MUST(pnpbs_placement_run(it.placement)); /* from the current nodes */
  MUST(pnpbs_placement_check(it.placement));
  MUST(pnpbs_placement_count(it.placement, &nodes));
  ck_assert_double_eq_tol((double)nodes / (double)mesh.n, 1, 0.015); /* 0.008 with a callback */
  pnpbs_placement_destroy(&it.placement);
  job_place(&it);
  if (_i < 2)
    set_mesh(it.placement, &mesh);
  else
    MUST(pnpbs_placement_set_spacing_points(it.placement, mesh.n, mesh.x, mesh.d));
  MUST(pnpbs_placement_run(it.placement)); /* without start nodes */
  MUST(pnpbs_placement_count(it.placement, &nodes));
  ck_assert_double_eq_tol((double)nodes / (double)mesh.n, 1, 0.01);
  ck_assert_double_gt(real_of(it.placement, "quality.mean"), 0.985);
  mesh_free(&mesh);
  job_end(&it);
}
END_TEST

static double between(const double* a, const double* b) {
  return sqrt(pow(a[0] - b[0], 2) + pow(a[1] - b[1], 2) + pow(a[2] - b[2], 2));
}

/* Returns the distance from x to the border of the mesh, and the value at the nearest point there.
 * The border consists of the sides that belong to one triangle; it is sampled. */
static double nearest_on_border(const sphere_mesh* mesh, const double* x, double* value) {
  enum { PARTS = 60 };
  double least = 3 * R;
  int64_t t, other;
  int k, l, c, part;
  for (t = 0; t < mesh->triangles; ++t)
    for (k = 0; k < 3; ++k) {
      const int64_t a = mesh->corners[3 * t + k], b = mesh->corners[3 * t + (k + 1) % 3];
      int alone = 1;
      if (between(mesh->x + 3 * a, x) > least + 1000) continue;
      for (other = 0; other < mesh->triangles && alone; ++other)
        for (l = 0; l < 3; ++l)
          alone = alone && !(mesh->corners[3 * other + l] == b &&
                             mesh->corners[3 * other + (l + 1) % 3] == a);
      for (part = 0; alone && part <= PARTS; ++part) {
        double y[3], size;
        for (c = 0; c < 3; ++c)
          y[c] = mesh->x[3 * a + c] + part * (mesh->x[3 * b + c] - mesh->x[3 * a + c]) / PARTS;
        size = sqrt(y[0] * y[0] + y[1] * y[1] + y[2] * y[2]);
        for (c = 0; c < 3; ++c) y[c] *= R / size;
        if (between(x, y) >= least) continue;
        least = between(x, y);
        *value = mesh->d[a] + part * (mesh->d[b] - mesh->d[a]) / PARTS;
      }
    }
  return 2 * R * asin(least / (2 * R));
}

/* The mesh covers the northern half. Beyond it d is that of the nearest point of the mesh. */
START_TEST(a_mesh_of_a_part) {
  sphere_mesh mesh = globe_mesh(20, -30, 800, sideways);
  job it = globe_from(20, -30);
  double *x, *d, expected;
  int64_t n, i, t, kept = 0, outside = 0;
  long all = 0, beyond = 0;
  const char* warning;
  for (t = 0; t < mesh.triangles; ++t) {
    const int64_t* c = mesh.corners + 3 * t;
    if (mesh.x[3 * c[0] + 2] < 0 || mesh.x[3 * c[1] + 2] < 0 || mesh.x[3 * c[2] + 2] < 0) continue;
    memmove(mesh.corners + 3 * kept++, c, 3 * sizeof *c);
  }
  mesh.triangles = kept;
  set_mesh(it.placement, &mesh);
  MUST(pnpbs_placement_set_double(it.placement, "growth_limit", 0));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  n = nodes_of(it.placement, &x, &d);
  for (i = 0; i < n; ++i) {
    double distance;
    for (t = 0; t < mesh.triangles && !value_on_ray(&mesh, t, x + 3 * i, &expected); ++t) continue;
    if (t < mesh.triangles) continue;
    distance = nearest_on_border(&mesh, x + 3 * i, &expected);
    outside += distance > d[i];
    /* Near the other pole the whole border is at about the same distance. */
    if (distance < 8000) ck_assert_double_eq_tol(d[i], expected, 2);
  }
  warning = warning_with(it.placement, "the background mesh of the spacing covers only a part");
  ck_assert_ptr_nonnull(warning);
  ck_assert_ptr_nonnull(strstr(warning, "one of them at (longitude "));
  ck_assert_ptr_null(strstr(warning, "reaches"));
  ck_assert_int_eq(sscanf(strstr(warning, "of the domain: of "),
                          "of the domain: of %ld nodes, %ld are", &all, &beyond),
                   2);
  ck_assert_double_eq_tol((double)beyond / (double)all, (double)outside / (double)n, 0.02);
  free(x);
  free(d);
  mesh_free(&mesh);
  job_end(&it);
}
END_TEST

/* d equals the values at the points, and a smooth function between them to second order. */
START_TEST(points_all_over_the_sphere) {
  static const double places[][2] = {{0, 90}, {180, 0}, {-160, 31}, {20, -90}, {19, 40}};
  const double spacing = 600, most = 100 * pow(spacing / R, 2) / 2;
  sphere_mesh cloud = globe_mesh(20, -30, spacing, sideways);
  job it = globe_from(20, -30);
  double fixed[3 * COUNT_OF(places)], *x, *d;
  int64_t n, i;
  int k, met = 0;
  for (k = 0; k < COUNT_OF(places); ++k) { /* finds the nearest of the points */
    double place[3], least = 3 * R;
    MUST(pnpbs_sphere_points(R, 1, places[k], place));
    for (i = 0; i < cloud.n; ++i) {
      if (between(cloud.x + 3 * i, place) >= least) continue;
      least = between(cloud.x + 3 * i, place);
      memcpy(fixed + 3 * k, cloud.x + 3 * i, 3 * sizeof *fixed);
    }
  }
  MUST(pnpbs_domain_add_fixed_nodes(it.domain, COUNT_OF(places), fixed, NULL));
  pnpbs_placement_destroy(&it.placement);
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_points(it.placement, cloud.n, cloud.x, cloud.d));
  MUST(pnpbs_placement_set_double(it.placement, "growth_limit", 0));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  ck_assert(!warning_with(it.placement, "covers only"));
  n = nodes_of(it.placement, &x, &d);
  for (i = 0; i < n; ++i) {
    double degrees[2];
    MUST(pnpbs_sphere_degrees(1, x + 3 * i, degrees));
    ck_assert_double_eq_tol(d[i], sideways(degrees[0], degrees[1]), most);
    for (k = 0; k < COUNT_OF(places); ++k) {
      if (between(x + 3 * i, fixed + 3 * k) > 1e-6) continue;
      ck_assert_double_eq_tol(d[i], sideways(degrees[0], degrees[1]), 1e-6);
      ++met;
    }
  }
  ck_assert_int_eq(met, COUNT_OF(places));
  free(x);
  free(d);
  mesh_free(&cloud);
  job_end(&it);
}
END_TEST

/* The points cover a part of the sphere and determine d on all of it. Their distances from the
 * centre do not matter. */
START_TEST(points_in_a_part) {
  double degrees[2 * 50], x[3 * 50], d[50];
  job it = globe_from(20, -30);
  int i;
  for (i = 0; i < 50; ++i) {
    degrees[2 * i] = 170 + 3 * (i % 10);
    degrees[2 * i + 1] = -10 + 5 * (double)(i / 10);
    d[i] = 400 + 10 * (i % 10);
  }
  MUST(pnpbs_sphere_points(3, 50, degrees, x));
  MUST(pnpbs_placement_set_spacing_points(it.placement, 50, x, d));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  ck_assert_ptr_nonnull(
      warning_with(it.placement, "the cloud of points of the spacing covers only a part"));
  pnpbs_placement_destroy(&it.placement);
  job_place(&it);
  MUST(pnpbs_placement_set_spacing_points(it.placement, 1, x, d));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  ck_assert_ptr_null(warning_with(it.placement, "covers only"));
  job_end(&it);
}
END_TEST

/* A single node of the mesh has a small d that samples of d would miss. The nodes must follow it,
 * also within the closing patch about the centre of projection. */
START_TEST(what_is_fine_at_one_node) {
  static const double places[2][2] = {{100, 50}, {20, -20}};
  sphere_mesh mesh = globe_mesh(70, 40, 250, NULL);
  job it = globe_from(20, -30);
  double place[3], *x, *d, least = 3 * R, finest = R;
  int64_t n, i, fine = 0, at = 0;
  MUST(pnpbs_sphere_points(R, 1, places[_i / 2], place));
  for (i = 0; i < mesh.n; ++i) {
    mesh.d[i] = 800;
    if (between(mesh.x + 3 * i, place) >= least) continue;
    least = between(mesh.x + 3 * i, place);
    fine = i;
  }
  mesh.d[fine] = 60;
  if (_i % 2 == 0)
    set_mesh(it.placement, &mesh);
  else
    MUST(pnpbs_placement_set_spacing_points(it.placement, mesh.n, mesh.x, mesh.d));
  MUST_COMPUTE(pnpbs_placement_run(it.placement));
  n = nodes_of(it.placement, &x, &d);
  for (i = 0; i < n; ++i) {
    if (d[i] >= finest) continue;
    finest = d[i];
    at = i;
  }
  ck_assert_double_lt(finest, 90);
  ck_assert_double_lt(between(x + 3 * at, mesh.x + 3 * fine), 90);
  free(x);
  free(d);
  mesh_free(&mesh);
  job_end(&it);
}
END_TEST

static int32_t constant_spacing(int64_t n, int32_t dim, const double* x, double* d, void* user) {
  int64_t i;
  (void)dim, (void)x;
  for (i = 0; i < n; ++i) d[i] = *(double*)user;
  return 0;
}

/* A coast with more vertices than d needs is simplified in the same way with d from a file as with
 * a callback. */
START_TEST(a_coast_is_simplified_by_a_file) {
  enum { VERTICES = 720 };
  const char* path = "sphere_fields_coast.csv";
  double degrees[2 * VERTICES], coast[3 * VERTICES], spacing = 300;
  int64_t vertices[2], curves[2];
  FILE* file = fopen(path, "w");
  int k, i;
  ck_assert(file);
  fprintf(file, "x,y,z,d\n0,0,1,%g\n1,0,0,%g\n0,-2,0,%g\n", spacing, spacing, spacing);
  ck_assert_int_eq(fclose(file), 0);
  for (i = 0; i < VERTICES; ++i) {
    degrees[2 * i] = 360.0 * i / VERTICES;
    degrees[2 * i + 1] = 40 + 0.4 * sin(i);
  }
  MUST(pnpbs_sphere_points(R, VERTICES, degrees, coast));
  for (k = 0; k < 2; ++k) {
    job it = globe_from(20, 90);
    MUST(pnpbs_domain_add_polyline(it.domain, PNPBS_BOUNDARY, 1, VERTICES, coast, NULL, 30));
    if (k == 0)
      MUST(pnpbs_domain_simplify(it.domain, constant_spacing, &spacing, 0.25, 0, vertices, curves));
    else
      MUST(pnpbs_domain_simplify_by_file(it.domain, path, "d", 0.25, 0, vertices + 1, curves + 1));
    job_end(&it);
  }
  remove(path);
  ck_assert_int_gt(vertices[0], VERTICES / 2);
  ck_assert_int_eq(vertices[1], vertices[0]);
  ck_assert_int_eq(curves[1], 0);
}
END_TEST

START_TEST(wrong_meshes_and_points) {
  double x[] = {1, 0, 0, 0, 2, 0, 0, 0, 3, -1, 0, 0, 0, 0, 0}, d[] = {300, 300, 300, 300, 300};
  const int64_t triangle[] = {0, 1, 2}, half_turn[] = {0, 3, 2}, no_node[] = {0, 1, 5};
  job it = globe_from(20, -30);
  pnpbs_placement p = it.placement;
  MUST(pnpbs_placement_set_spacing_mesh(p, 3, x, d, 1, triangle));
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_set_spacing_mesh(p, 4, x, d, 1, half_turn),
            "argument corners[0]", "great circle");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_set_spacing_mesh(p, 5, x, d, 1, no_node),
            "argument corners[0][2] = 5", "5 nodes");
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_set_spacing_points(p, 5, x, d),
            "argument coordinates[4] = (0, 0, 0)", "direction");
  x[3] = NAN;
  MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_placement_set_spacing_points(p, 4, x, d),
            "argument coordinates[1]", "nan");
  x[3] = 0, d[1] = -1;
  MUST_FAIL(PNPBS_ERROR_SPACING, pnpbs_placement_set_spacing_points(p, 3, x, d), "argument d[1]",
            "-1");
  x[3] = 5, x[4] = 0; /* at the position of the first one */
  d[1] = 200;
  MUST_FAIL(PNPBS_ERROR_SPACING, pnpbs_placement_set_spacing_points(p, 3, x, d), "argument d[",
            "a point has one spacing");
  job_end(&it);
}
END_TEST

TEST_SUITE(test_sphere_fields) {
  Suite* suite = suite_create("sphere_fields");
  TCase *grids = tcase_create("grids"), *fields = tcase_create("fields");
  tcase_add_loop_test(grids, a_grid_around_the_sphere, 0, 7);
  tcase_add_test(grids, a_grid_has_as_many_nodes_as_its_function);
  tcase_add_loop_test(grids, a_low_value_of_a_grid, 0, 3);
  tcase_add_test(grids, a_pole_has_one_spacing);
  tcase_add_test(grids, a_grid_beside_the_domain);
  tcase_add_test(grids, a_grid_of_some_latitudes);
  tcase_add_test(grids, a_grid_of_some_longitudes);
  tcase_add_test(grids, wrong_grids);
  tcase_set_timeout(grids, 0);
  suite_add_tcase(suite, grids);
  tcase_add_loop_test(fields, a_mesh_of_the_whole_sphere, 0, 3);
  tcase_add_loop_test(fields, as_many_nodes_by_their_own_spacing, 0, 4);
  tcase_add_test(fields, a_mesh_of_a_part);
  tcase_add_test(fields, points_all_over_the_sphere);
  tcase_add_test(fields, points_in_a_part);
  tcase_add_loop_test(fields, what_is_fine_at_one_node, 0, 4);
  tcase_add_test(fields, a_coast_is_simplified_by_a_file);
  tcase_add_test(fields, wrong_meshes_and_points);
  tcase_set_timeout(fields, 0);
  suite_add_tcase(suite, fields);
  return run_suite(suite);
}
