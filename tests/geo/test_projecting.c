/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests projected coordinates against formulas from the literature, and the ways in which a
 * projection is named, selected and reported.
 */
#include "geo_support.h"

static const double pi = 3.14159265358979323846;

/* An ellipsoid. The shorter axes of GRS 80 and WGS 84 differ by 0.1 mm. */
typedef struct ellipsoid {
  double a, f;
} ellipsoid;
static const ellipsoid grs80 = {6378137, 1 / 298.257222101}, wgs84 = {6378137, 1 / 298.257223563};

/* Computes the transverse Mercator projection by Krueger's series to the fourth order of n, with an
 * error below a micrometre within 10 degrees: C. F. F. Karney, "Transverse Mercator with an
 * accuracy of a few nanometers", J. Geod. 85 (2011) 475-485, equations (7) to (14), (35). */
static void transverse_mercator(ellipsoid e, double lon0, double k0, double lon, double lat,
                                double* xy) {
  const double n = e.f / (2 - e.f), n2 = n * n, n3 = n2 * n, n4 = n2 * n2;
  const double radius = e.a / (1 + n) * (1 + n2 / 4 + n4 / 64);
  const double alpha[4] = {n / 2 - 2 * n2 / 3 + 5 * n3 / 16 + 41 * n4 / 180,
                           13 * n2 / 48 - 3 * n3 / 5 + 557 * n4 / 1440,
                           61 * n3 / 240 - 103 * n4 / 140, 49561 * n4 / 161280};
  const double ecc = sqrt(e.f * (2 - e.f)), tau = tan(lat * pi / 180);
  const double sigma = sinh(ecc * atanh(ecc * tau / sqrt(1 + tau * tau)));
  const double conformal = tau * sqrt(1 + sigma * sigma) - sigma * sqrt(1 + tau * tau);
  const double lambda = (lon - lon0) * pi / 180;
  const double xi0 = atan2(conformal, cos(lambda));
  const double eta0 = asinh(sin(lambda) / sqrt(conformal * conformal + cos(lambda) * cos(lambda)));
  double xi = xi0, eta = eta0;
  int j;
  for (j = 1; j <= 4; ++j) {
    xi += alpha[j - 1] * sin(2 * j * xi0) * cosh(2 * j * eta0);
    eta += alpha[j - 1] * cos(2 * j * xi0) * sinh(2 * j * eta0);
  }
  xy[0] = k0 * radius * eta;
  xy[1] = k0 * radius * xi;
}

static double authalic(double ecc, double sine) {
  const double es = ecc * sine;
  return (1 - ecc * ecc) * (sine / (1 - es * es) - log((1 - es) / (1 + es)) / (2 * ecc));
}

/* Computes Lambert's azimuthal equal-area projection: J. P. Snyder, "Map projections: a working
 * manual", USGS Professional Paper 1395 (1987), equations (24-17) to (24-20), (3-11), (3-12). */
static void azimuthal(ellipsoid e, double lon0, double lat0, double lon, double lat, double* xy) {
  const double ecc = sqrt(e.f * (2 - e.f)), qp = authalic(ecc, 1);
  const double s1 = sin(lat0 * pi / 180), c1 = cos(lat0 * pi / 180);
  const double beta = asin(authalic(ecc, sin(lat * pi / 180)) / qp);
  const double beta1 = asin(authalic(ecc, s1) / qp), lambda = (lon - lon0) * pi / 180;
  const double rq = e.a * sqrt(qp / 2);
  const double d = e.a * c1 / sqrt(1 - ecc * ecc * s1 * s1) / (rq * cos(beta1));
  const double b =
      rq * sqrt(2 / (1 + sin(beta1) * sin(beta) + cos(beta1) * cos(beta) * cos(lambda)));
  xy[0] = b * d * cos(beta) * sin(lambda);
  xy[1] = b / d * (cos(beta1) * sin(beta) - sin(beta1) * cos(beta) * cos(lambda));
}

/* Expects that each of these points is an end of a segment of the domain, to 0.1 mm. */
static void expect_points(pnpbs_domain domain, int n, double (*points)[2], double unit) {
  static double segments[256][2][2];
  int64_t count = 0;
  int i;
  ck_assert_int_eq(pnpbs_domain_get_segments(domain, 256, &count, segments[0][0], NULL), PNPBS_OK);
  for (i = 0; i < n; ++i) {
    double nearest = INFINITY;
    int64_t s;
    for (s = 0; s < count; ++s)
      nearest = fmin(nearest, hypot(segments[s][0][0] * unit - points[i][0],
                                    segments[s][0][1] * unit - points[i][1]));
    ck_assert_msg(nearest < 1e-4, "point %d (%.9g, %.9g) is %g m away", i, points[i][0],
                  points[i][1], nearest);
  }
}

static void expect_name(pnpbs_geo_shapes shapes, const char* expected, const char* expected_unit) {
  const char *name = NULL, *unit = NULL;
  GEO_MUST(pnpbs_geo_projection(shapes, &name, &unit, NULL, NULL, NULL));
  ck_assert_str_eq(name, expected);
  ck_assert_str_eq(unit, expected_unit);
}

/* A polygon around the bay of Gdansk. */
static double bay[4][2] = {{18.5, 54.4}, {19.75, 54.375}, {19.6, 54.8}, {18.4, 54.85}};
#define BAY \
  FEATURE("Polygon", "[[[18.5,54.4],[19.75,54.375],[19.6,54.8],[18.4,54.85],[18.5,54.4]]]")

START_TEST(named) {
  double expected[4][2];
  int i, k;
  for (i = 0; i < 4; ++i) { /* EPSG:2180 */
    transverse_mercator(grs80, 19, 0.9993, bay[i][0], bay[i][1], expected[i]);
    expected[i][0] += 500000;
    expected[i][1] -= 5300000;
  }
  for (k = 0; k < 2; ++k) {
    geo_case it = geo_begin(write_geojson("bay.geojson", BAY), "EPSG:2180", k ? "km" : NULL, NULL);
    expect_points(it.domain, 4, expected, k ? 1000 : 1);
    expect_name(it.shapes, k ? "ETRF2000-PL / CS92 in kilometre" : "ETRF2000-PL / CS92",
                k ? "kilometre" : "metre");
    expect_counts(it.shapes, 4, 1, 0, 0);
    geo_end(&it);
  }
}
END_TEST

START_TEST(of_proj) {
  double expected[4][2];
  int i;
  geo_case it = geo_begin(write_geojson("bay.geojson", BAY),
                          "+proj=laea +lat_0=52 +lon_0=10 +datum=WGS84 +units=km", NULL, NULL);
  for (i = 0; i < 4; ++i) azimuthal(wgs84, 10, 52, bay[i][0], bay[i][1], expected[i]);
  expect_points(it.domain, 4, expected, 1000);
  geo_end(&it);
}
END_TEST

START_TEST(zone_that_data_lie_in) {
  const char* const projections[] = {NULL, "auto"};
  double expected[4][2];
  int i, k;
  for (i = 0; i < 4; ++i) {
    transverse_mercator(wgs84, 21, 0.9996, bay[i][0], bay[i][1], expected[i]);
    expected[i][0] += 500000;
  }
  for (k = 0; k < 2; ++k) {
    geo_case it = geo_begin(write_geojson("bay.geojson", BAY), projections[k], NULL, NULL);
    expect_points(it.domain, 4, expected, 1);
    expect_name(it.shapes, "WGS 84 / UTM zone 34N", "metre");
    geo_end(&it);
  }
}
END_TEST

START_TEST(southern_zone) {
  geo_case it = geo_begin(
      write_geojson("cook.geojson", FEATURE("Polygon", "[[[174,-41],[175,-41],[175,-40]]]")), NULL,
      NULL, NULL);
  expect_name(it.shapes, "WGS 84 / UTM zone 60S", "metre");
  geo_end(&it);
}
END_TEST

START_TEST(too_wide_for_a_zone) {
  double corners[4][2] = {{-10, 40}, {20, 40}, {20, 60.5}, {-10, 60.5}}, expected[4][2];
  int i;
  geo_case it = geo_begin(
      write_geojson("wide.geojson",
                    FEATURE("Polygon", "[[[-10,40],[20,40],[20,60.5],[-10,60.5],[-10,40]]]")),
      NULL, "km", NULL);
  expect_name(it.shapes, "WGS 84 / Lambert azimuthal equal-area at 50 N, 5 E in kilometre",
              "kilometre");
  for (i = 0; i < 4; ++i) azimuthal(wgs84, 5, 50, corners[i][0], corners[i][1], expected[i]);
  expect_points(it.domain, 4, expected, 1000);
  geo_end(&it);
}
END_TEST

/* Parts of a feature that was cut at 180 degrees are joined. Longitudes above 180 degrees are
 * equivalent to negative ones. */
START_TEST(across_180_degrees) {
  double corners[4][2] = {{176, -18}, {184, -18}, {184, -15}, {176, -15}}, expected[4][2];
  int i;
  geo_case it = geo_begin(
      write_geojson("fiji.geojson",
                    FEATURE("MultiPolygon",
                            "[[[[176,-18],[180,-18],[180,-15],[176,-15],[176,-18]]],"
                            "[[[-180,-18],[-176,-18],[-176,-15],[-180,-15],[-180,-18]]]]")),
      NULL, NULL, NULL);
  expect_name(it.shapes, "WGS 84 / Lambert azimuthal equal-area at 17 S, 180 E", "metre");
  expect_counts(it.shapes, 6, 1, 0, 0);
  ck_assert(has_note(it.shapes, "180 degrees"));
  for (i = 0; i < 4; ++i) azimuthal(wgs84, 180, -17, corners[i][0], corners[i][1], expected[i]);
  expect_points(it.domain, 4, expected, 1);
  geo_end(&it);
}
END_TEST

/* Antarctica in longitude and latitude has a cut to the pole and back. */
START_TEST(around_a_pole) {
  geo_case it = geo_begin(
      write_geojson(
          "pole.geojson",
          FEATURE("Polygon",
                  "[[[-180,-90],[-180,-70],[-90,-72],[0,-70],[90,-68],[180,-70],[180,-90],"
                  "[0,-90],[-180,-90]]]")),
      NULL, "km", NULL);
  expect_name(it.shapes, "WGS 84 / Lambert azimuthal equal-area at 90 S, 0 in kilometre",
              "kilometre");
  expect_counts(it.shapes, 5, 1, 0, 0);
  /* The domain is a square with its corners on meridians, about 20 degrees from the pole. */
  ck_assert_double_eq_tol(geo_area(&it), 2 * 2220. * 2220., 0.02 * 2 * 2220. * 2220.);
  geo_end(&it);
}
END_TEST

/* PROJ cannot compute the inverse projection of the pole from some of these points. */
START_TEST(corner_at_a_pole) {
  static const char* const seen_from[] = {"sphere(0,0)", "sphere(0,-15)", "sphere(-135,-7.5)",
                                          "sphere(-180,-22.5)"};
  const char* path =
      write_geojson("corner.geojson", FEATURE("Polygon", "[[[0,-90],[100,-75],[10,-75]]]"));
  size_t k;
  for (k = 0; k < sizeof seen_from / sizeof seen_from[0]; ++k) {
    pnpbs_geo_shapes shapes = NULL;
    GEO_MUST(pnpbs_geo_read(path, NULL, seen_from[k], NULL, NULL, &shapes));
    GEO_MUST(pnpbs_geo_destroy(&shapes));
  }
}
END_TEST

START_TEST(as_they_are) {
  geo_case it = geo_begin(write_geojson("bay.geojson", BAY), "none", NULL, NULL);
  expect_points(it.domain, 4, bay, 1);
  expect_name(it.shapes, "WGS 84", "degree");
  ck_assert(has_note(it.shapes, "as requested"));
  geo_end(&it);
}
END_TEST

START_TEST(to_degrees_and_back) {
  double x[2][2] = {{18.5, 54.4}, {19.75, 54.375}};
  geo_case it = geo_begin(write_geojson("bay.geojson", BAY), "EPSG:3035", NULL, NULL);
  GEO_MUST(pnpbs_geo_from_degrees(it.shapes, 2, x[0]));
  ck_assert_double_gt(x[0][0],
                      4e6); /* east before north, although the register has the other order */
  ck_assert_double_lt(x[0][1], 4e6);
  GEO_MUST(pnpbs_geo_to_degrees(it.shapes, 2, x[0]));
  ck_assert_double_eq_tol(x[0][0], 18.5, 1e-8); /* which is a millimetre */
  ck_assert_double_eq_tol(x[1][1], 54.375, 1e-8);
  GEO_MUST(pnpbs_geo_to_degrees(it.shapes, 0, NULL));
  GEO_MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_geo_to_degrees(it.shapes, -1, x[0]), "n = -1",
                "negative");
  GEO_MUST_FAIL(PNPBS_ERROR_ARGUMENT, pnpbs_geo_to_degrees(it.shapes, 1, NULL), "coordinates",
                "NULL");
  geo_end(&it);
}
END_TEST

/* The projection written beside results can be read again and is the same. */
START_TEST(written_beside_results) {
  char prj[1024], path[1024];
  double x[2] = {18.5, 54.4}, y[2] = {18.5, 54.4};
  geo_case it = geo_begin(write_geojson("bay.geojson", BAY), "EPSG:2180", "km", NULL), again;
  snprintf(path, sizeof path, "%s/nodes.vtu", PNPBS_TEST_WORK_DIR);
  GEO_MUST(pnpbs_geo_write_prj(it.shapes, path));
  snprintf(prj, sizeof prj, "%s/nodes.prj", PNPBS_TEST_WORK_DIR);
  again = geo_begin(write_geojson("bay.geojson", BAY), prj, NULL, NULL);
  GEO_MUST(pnpbs_geo_from_degrees(it.shapes, 1, x));
  GEO_MUST(pnpbs_geo_from_degrees(again.shapes, 1, y));
  ck_assert_double_eq_tol(x[0], y[0], 1e-9);
  ck_assert_double_eq_tol(x[1], y[1], 1e-9);
  geo_end(&again);
  {
    const char *proj = NULL, *wkt = NULL, *esri = NULL;
    GEO_MUST(pnpbs_geo_projection(it.shapes, NULL, NULL, &proj, &wkt, &esri));
    ck_assert_ptr_nonnull(strstr(proj, "+units=km"));
    ck_assert_ptr_nonnull(strstr(wkt, "PROJCRS["));
    ck_assert_ptr_nonnull(strstr(esri, "PROJCS["));
    again = geo_begin(write_geojson("bay.geojson", BAY), wkt, NULL, NULL);
    geo_end(&again);
  }
  GEO_MUST_FAIL(PNPBS_ERROR_FILE, pnpbs_geo_write_prj(it.shapes, "/nowhere/nodes.vtu"),
                "/nowhere/nodes.prj", "cannot write");
  geo_end(&it);
}
END_TEST

START_TEST(lengths_that_are_off) {
  const double e2 = wgs84.f * (2 - wgs84.f), sine = sin(60 * pi / 180);
  double least = 0, greatest = 0;
  geo_case it = geo_begin(write_geojson("bay.geojson", BAY), NULL, NULL, NULL);
  GEO_MUST(pnpbs_geo_scale(it.shapes, &least, &greatest));
  ck_assert(least > 0.9996 && greatest < 1.0006); /* as in a UTM zone */
  ck_assert(!has_note(it.shapes, "lengths"));
  geo_end(&it);
  it = geo_begin(write_geojson("far.geojson", FEATURE("Polygon", "[[[0,0],[1,0],[1,60],[0,60]]]")),
                 "EPSG:3857", NULL, NULL);
  GEO_MUST(pnpbs_geo_scale(it.shapes, &least, &greatest));
  /* The scale is a / (N cos(latitude)). At the equator it is a / N = 1 along it, and a / M = 1 / (1
   * - e^2) across. */
  ck_assert_double_eq_tol(least, 1, 1e-6);
  ck_assert_double_eq_tol(greatest, 2 * pow(1 - e2 * sine * sine, 1.5) / (1 - e2), 1e-6);
  ck_assert(has_note(it.shapes, "lengths are 1 to 1.99"));
  geo_end(&it);
}
END_TEST

static void refuse(const char* features, const char* projection, const char* unit,
                   pnpbs_status status, const char* part, const char* other_part) {
  pnpbs_geo_shapes shapes = (pnpbs_geo_shapes)(void*)&shapes;
  const char* const path = write_geojson("refused.geojson", features);
  GEO_MUST_FAIL(status, pnpbs_geo_read(path, NULL, projection, unit, NULL, &shapes), part,
                other_part);
  ck_assert_ptr_null(shapes);
}

START_TEST(what_is_no_projection) {
  refuse(BAY, "EPSG:99999999", NULL, PNPBS_ERROR_ARGUMENT, "EPSG:99999999", "EPSG:2180");
  refuse(BAY, "+proj=nonsense", NULL, PNPBS_ERROR_ARGUMENT, "+proj=nonsense", "auto");
  refuse(BAY, "https://example.org/x", NULL, PNPBS_ERROR_ARGUMENT, "https:", "names no projection");
  refuse(BAY, "EPSG:4326", NULL, PNPBS_ERROR_ARGUMENT, "EPSG:4326", "no lengths");
  refuse(BAY, "auto", "mile", PNPBS_ERROR_ARGUMENT, "mile", "m or km");
  refuse(BAY, "none", "km", PNPBS_ERROR_ARGUMENT, "km", "as they are");
}
END_TEST

START_TEST(what_cannot_be_projected) {
  refuse(FEATURE("Polygon", "[[[20,95],[21,95],[21,96]]]"), NULL, NULL, PNPBS_ERROR_FILE,
         "none of the coordinates", "WGS 84");
  refuse(FEATURE("Polygon", "[[[20,50],[21,95],[21,50]]]"), NULL, NULL, PNPBS_ERROR_FILE,
         "feature 0: (21, 95)", "cannot be projected");
  refuse(FEATURE("Polygon", "[[[19,50],[109,0.01],[21,51]]]"), "EPSG:2180", NULL, PNPBS_ERROR_FILE,
         "(109, 0.01)", "ETRF2000-PL / CS92");
  refuse(FEATURE("Polygon", "[[[-170,-50],[170,-50],[170,60],[10,60],[-60,10]]]"), NULL, NULL,
         PNPBS_ERROR_ARGUMENT, "auto", "both sides of the equator");
}
END_TEST

TEST_SUITE(test_projecting) {
  Suite* suite = suite_create("projecting shapes");
  TCase* cases = tcase_create("all");
  tcase_add_test(cases, named);
  tcase_add_test(cases, of_proj);
  tcase_add_test(cases, zone_that_data_lie_in);
  tcase_add_test(cases, southern_zone);
  tcase_add_test(cases, too_wide_for_a_zone);
  tcase_add_test(cases, across_180_degrees);
  tcase_add_test(cases, around_a_pole);
  tcase_add_test(cases, corner_at_a_pole);
  tcase_add_test(cases, as_they_are);
  tcase_add_test(cases, to_degrees_and_back);
  tcase_add_test(cases, written_beside_results);
  tcase_add_test(cases, lengths_that_are_off);
  tcase_add_test(cases, what_is_no_projection);
  tcase_add_test(cases, what_cannot_be_projected);
  suite_add_tcase(suite, cases);
  return run_suite(suite);
}
