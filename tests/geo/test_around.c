/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests outlines that go around the Earth or over a pole, together with a square island on the
 * equator. They lie on a sphere of radius 1, whose segments are parts of great circles, or in a
 * plane about a pole.
 */
#include "geo_support.h"

#define POLYGON(coordinates) FEATURE("Polygon", "[[" coordinates "]]")
#define ISLAND POLYGON("[-5,-5],[5,-5],[5,5],[-5,5]")

static const double degree = 3.14159265358979323846 / 180;

/* Returns the area of the spherical triangle of a pole and two points at this latitude, `apart`
 * degrees of longitude from each other. */
static double triangle(double latitude, double apart) {
  const double side = tan((90 - fabs(latitude)) / 2 * degree), square = side * side;
  return 2 * atan2(square * sin(apart * degree), 1 + square * cos(apart * degree));
}

/* Returns the area of the island. It consists of right-angled triangles about its centre. */
static double island_area(void) {
  const double corner[3] = {cos(5 * degree) * cos(5 * degree), cos(5 * degree) * sin(5 * degree),
                            sin(5 * degree)};
  const double away = atan2(hypot(corner[1], corner[2]), corner[0]);
  const double turn = 2 * atan2(corner[1], corner[2]), square = tan(away / 2) * tan(away / 2);
  const double upper = 2 * atan2(square * sin(turn), 1 + square * cos(turn));
  const double side = 2 * atan2(corner[2], corner[1]);
  return 2 * (upper + 2 * atan2(square * sin(side), 1 + square * cos(side)));
}

static geo_case on_sphere(const char* features, const double outside[2]) {
  char projection[64];
  double place[3];
  geo_case it = {NULL, NULL, NULL};
  snprintf(projection, sizeof projection, "sphere(%g,%g)", outside[0], outside[1]);
  GEO_MUST(pnpbs_geo_read(write_geojson("around.geojson", features), NULL, projection, NULL, NULL,
                          &it.shapes));
  ck_assert_int_eq(pnpbs_context_create_serial(&it.context), PNPBS_OK);
  ck_assert_int_eq(pnpbs_sphere_points(1, 1, outside, place), PNPBS_OK);
  ck_assert_int_eq(pnpbs_domain_create_sphere(it.context, 1, place, &it.domain), PNPBS_OK);
  GEO_MUST(pnpbs_geo_add_to_domain(it.shapes, it.context, it.domain, 0));
  ck_assert_msg(pnpbs_domain_check(it.domain) == PNPBS_OK, "%s",
                pnpbs_geo_explain(it.shapes, pnpbs_last_error(it.context)));
  return it;
}

/* Checks the area of the domain with outside points on the island and in the sea. The domain is
 * then everything except the island and the insides of the outlines, or these insides and the
 * island. */
static void expect_areas(const char* outlines, double area) {
  const double on_island[2] = {0, 0}, in_sea[2] = {40, 10};
  const double sphere = 720 * degree;
  char features[16384];
  geo_case it;
  snprintf(features, sizeof features, "%s," ISLAND, outlines);
  it = on_sphere(features, on_island);
  ck_assert_double_eq_tol(geo_area(&it), sphere - island_area() - area, 5e-4);
  geo_end(&it);
  it = on_sphere(features, in_sea);
  ck_assert_double_eq_tol(geo_area(&it), island_area() + area, 5e-4);
  geo_end(&it);
}

/* Returns the text of points at a latitude, beginning at a longitude, in this number of steps,
 * followed by further points of the outline. */
static const char* ring(double latitude, double from, double step, int steps, const char* more) {
  static char text[4096];
  int length = snprintf(text, sizeof text, "%s", "");
  int k;
  for (k = 0; k <= steps; ++k)
    length += snprintf(text + length, sizeof text - (size_t)length, "%s[%g,%g]", k ? "," : "",
                       from + k * step, latitude);
  snprintf(text + length, sizeof text - (size_t)length, "%s", more);
  return text;
}

static const char* polygon(const char* corners) {
  static char text[8192];
  snprintf(text, sizeof text,
           "{\"type\":\"Feature\",\"properties\":{},\"geometry\":{\"type\":\"Polygon\","
           "\"coordinates\":[[%s]]}}",
           corners);
  return text;
}

START_TEST(along_parallels) {
  const double latitudes[] = {-74, -30, 30, 74};
  size_t k;
  for (k = 0; k < sizeof latitudes / sizeof latitudes[0]; ++k) {
    const double area = 72 * triangle(latitudes[k], 5);
    expect_areas(polygon(ring(latitudes[k], -180, 5, 71, "")), area);
    expect_areas(polygon(ring(latitudes[k], 180, -5, 71, "")), area);
    expect_areas(polygon(ring(latitudes[k], 0, 5, 72, "")), area);
    expect_areas(polygon(ring(latitudes[k], 2.5, 5, 71, "")), area);
    expect_areas(polygon(ring(latitudes[k], -60, 120, 2, "")), 3 * triangle(latitudes[k], 120));
  }
}
END_TEST

/* The cut along a meridian may have different vertices on both sides, or the same. */
START_TEST(cut_to_a_pole) {
  const double area = 72 * triangle(-74, 5);
  expect_areas(polygon(ring(-74, -180, 5, 72, ",[180,-90],[-180,-90]")), area);
  expect_areas(polygon(ring(-74, -180, 5, 72, ",[180,-80],[180,-90],[-180,-90],[-180,-80]")), area);
  expect_areas(polygon(ring(-74, -180, 5, 72, ",[180,-90],[-180,-90],[-180,-80]")), area);
  expect_areas(polygon(ring(-74, -180, 5, 72, ",[180,-79],[180,-90],[90,-90],[-180,-90]")), area);
  expect_areas(polygon(ring(-74, 10, 5, 72, ",[370,-90],[10,-90],[10,-81]")), area);
  expect_areas(polygon(ring(74, -180, 5, 72, ",[180,80],[180,90],[-180,90]")),
               72 * triangle(74, 5));
}
END_TEST

/* A single outline may touch itself as well. */
START_TEST(alone) {
  const double outside[2] = {0, -80};
  geo_case it =
      on_sphere(polygon(ring(-74, -180, 5, 72, ",[180,-90],[-180,-90],[-180,-80]")), outside);
  ck_assert_double_eq_tol(geo_area(&it), 720 * degree - 72 * triangle(-74, 5), 5e-4);
  geo_end(&it);
}
END_TEST

START_TEST(corner_at_a_pole) {
  expect_areas(polygon(ring(-60, 90, 10, 14, ",[0,-90]")), 14 * triangle(-60, 10));
  expect_areas(polygon(ring(60, -170, 10, 10, ",[180,90]")), 10 * triangle(60, 10));
}
END_TEST

/* The outline returns along a great circle, which passes over the pole or not. */
START_TEST(part_of_a_parallel) {
  expect_areas(polygon(ring(70, 0, 90, 2, "")), 2 * triangle(70, 90));
  expect_areas(polygon(ring(-70, -90, 20, 9, "")), 9 * triangle(-70, 20));
  expect_areas(polygon(ring(60, -60, 20, 6, "")), 6 * triangle(60, 20) - triangle(60, 120));
  expect_areas(polygon(ring(-60, 120, 20, 6, "")), 6 * triangle(-60, 20) - triangle(-60, 120));
}
END_TEST

/* An outline of nearly no width is not an island. */
START_TEST(spikes) {
  geo_case it;
  const double outside[2] = {0, 0};
  it = on_sphere(ISLAND "," POLYGON("[20,50],[20.1,50],[20.2,50],[20,50]"), outside);
  ck_assert(has_note(it.shapes, "4 segments"));
  geo_end(&it);
}
END_TEST

/* Two neighbours lie on both sides of 180 degrees. Only one of them has vertices on their common
 * edge. */
START_TEST(neighbours_across_180_degrees) {
  const char* const north = POLYGON("[170,50],[-170,50],[-170,60],[170,60]");
  const char* const south = POLYGON(
      "[170,50],[175,50],[180,50],[-175,50],[-170,50],[-170,40],"
      "[170,40]");
  const double outside[2] = {0, 0};
  char features[2048];
  int k;
  for (k = 0; k < 2; ++k) {
    int64_t inner = -1;
    geo_case it;
    snprintf(features, sizeof features, "%s,%s", k ? north : south, k ? south : north);
    it = on_sphere(features, outside);
    GEO_MUST(pnpbs_geo_counts(it.shapes, NULL, NULL, &inner, NULL));
    ck_assert_int_eq(inner, 1);
    geo_end(&it);
    it = geo_begin(write_geojson("across.geojson", features), NULL, "km", NULL);
    expect_counts(it.shapes, 9, 2, 1, 0);
    geo_end(&it);
  }
}
END_TEST

static double part_in_a_plane(const char* others) {
  char features[16384];
  geo_case it;
  double area;
  snprintf(features, sizeof features, "%s%s", polygon(ring(-60, -60, 20, 6, "")), others);
  it = geo_begin(write_geojson("around.geojson", features), "EPSG:3031", "km", NULL);
  area = geo_area(&it);
  geo_end(&it);
  return area;
}

/* The outline returns along the straight line of the projection. */
START_TEST(part_in_a_plane_about_a_pole) {
  const double part = part_in_a_plane("");
  const double beside = part_in_a_plane("," POLYGON("[90,-80],[91,-80],[91,-81]"));
  ck_assert_double_gt(part, 6e6);
  ck_assert_double_eq_tol(beside / part, 1, 0.001);
}
END_TEST

/* Lambert's projection about the pole is continuous at 180 degrees, whereas Mercator's is not. */
START_TEST(in_a_plane) {
  char features[16384];
  geo_case it;
  double alone, beside;
  snprintf(features, sizeof features, "%s", polygon(ring(-74, -180, 5, 71, "")));
  it = geo_begin(write_geojson("around.geojson", features), NULL, "km", NULL);
  alone = geo_area(&it);
  geo_end(&it);
  snprintf(features, sizeof features, "%s," POLYGON("[20,-60],[21,-60],[21,-61]"),
           polygon(ring(-74, -180, 5, 71, "")));
  it = geo_begin(write_geojson("around.geojson", features), NULL, "km", NULL);
  beside = geo_area(&it);
  expect_counts(it.shapes, 75, 2, 0, 0);
  ck_assert_double_eq_tol(beside / alone, 1, 0.01);
  geo_end(&it);
  /* A strip over all longitudes has a neighbour with one more vertex on their common side. */
  it = geo_begin(
      write_geojson("around.geojson", POLYGON("[-170,0],[170,0],[170,10],[-170,10]") "," POLYGON(
                                          "[-170,0],[20,0],[170,0],[170,-10],[-170,-10]")),
      "EPSG:3395", "km", NULL);
  expect_counts(it.shapes, 7, 2, 1, 0);
  geo_end(&it);
}
END_TEST

TEST_SUITE(test_around) {
  Suite* suite = suite_create("shapes around the Earth");
  TCase* cases = tcase_create("all");
  tcase_add_test(cases, along_parallels);
  tcase_add_test(cases, cut_to_a_pole);
  tcase_add_test(cases, alone);
  tcase_add_test(cases, corner_at_a_pole);
  tcase_add_test(cases, part_of_a_parallel);
  tcase_add_test(cases, spikes);
  tcase_add_test(cases, neighbours_across_180_degrees);
  tcase_add_test(cases, part_in_a_plane_about_a_pole);
  tcase_add_test(cases, in_a_plane);
  suite_add_tcase(suite, cases);
  return run_suite(suite);
}
