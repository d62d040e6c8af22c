/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Tests lines that run along the boundary, which change its tag and are not curves of their own.
 * Also tests lines around polygons. The sea is a square of side 10 with tag 1.
 */
#include "geo_support.h"

#define LINE(tag, coordinates)                           \
  ",{\"type\":\"Feature\",\"properties\":{\"tag\":" #tag \
  "},\"geometry\":{\"type\":\"LineString\",\"coordinates\":" coordinates "}}"
#define POLYGON(coordinates)                                        \
  "{\"type\":\"Feature\",\"properties\":{\"tag\":1},\"geometry\":{" \
  "\"type\":\"Polygon\",\"coordinates\":" coordinates "}}"
#define SEA POLYGON("[[[0,0],[10,0],[10,10],[0,10]]]")

static geo_case begin(const char* features) {
  return geo_begin(write_geojson("shores.geojson", features), "none", NULL, "tag");
}

/* Returns the total length of the segments with this tag. */
static double length_of(const geo_case* it, int32_t tag) {
  double segments[64][2][2], length = 0;
  int32_t tags[64];
  int64_t count = 0, s;
  ck_assert_int_eq(pnpbs_domain_get_segments(it->domain, 64, &count, segments[0][0], tags),
                   PNPBS_OK);
  for (s = 0; s < count; ++s)
    if (tags[s] == tag)
      length += hypot(segments[s][1][0] - segments[s][0][0], segments[s][1][1] - segments[s][0][1]);
  return length;
}

static void expect_lengths(const char* lines, double shore, double open, int64_t inner) {
  int64_t found = -1;
  char features[4096];
  geo_case it;
  snprintf(features, sizeof features, SEA "%s", lines);
  it = begin(features);
  ck_assert_double_eq_tol(geo_area(&it), 100, 1e-9);
  ck_assert_double_eq_tol(length_of(&it, 1), shore, 0.021);
  ck_assert_double_eq_tol(length_of(&it, 5), open, 0.021);
  GEO_MUST(pnpbs_geo_counts(it.shapes, NULL, NULL, &found, NULL));
  ck_assert_int_eq(found, inner);
  geo_end(&it);
}

START_TEST(same_vertices) {
  expect_lengths(LINE(5, "[[10,0],[10,10]]"), 30, 10, 0);
  expect_lengths(LINE(5, "[[10,10],[10,0],[0,0]]"), 20, 20, 0);
  expect_lengths(LINE(5, "[[10,0],[10,10],[0,10],[0,0],[10,0]]"), 0, 40, 0);
}
END_TEST

/* The line begins and ends between vertices of the boundary, in either direction, around a corner
 * and over the first vertex of the outline. */
START_TEST(parts_of_segments) {
  expect_lengths(LINE(5, "[[10,2],[10,7]]"), 35, 5, 0);
  expect_lengths(LINE(5, "[[10,7],[10,2]]"), 35, 5, 0);
  expect_lengths(LINE(5, "[[8,0],[10,0],[10,3]]"), 35, 5, 0);
  expect_lengths(LINE(5, "[[0,3],[0,0],[4,0]]"), 33, 7, 0);
}
END_TEST

/* Lines drawn by hand deviate by at most a thousandth of the extent. The area does not change. */
START_TEST(near_the_boundary) {
  expect_lengths(LINE(5, "[[10.005,2],[9.994,4],[10.003,7]]"), 35, 5, 0);
  expect_lengths(LINE(5, "[[8,-0.006],[9.995,0.004],[10.007,3]]"), 35, 5, 0);
  expect_lengths(LINE(5, "[[10.004,0.006],[9.995,10.003]]"), 30, 10, 0);
  /* Differences by rounding do not cause separate segments. */
  expect_lengths(LINE(5, "[[10,1e-13],[10,9.9999999999999]]"), 30, 10, 0);
  expect_lengths(
      LINE(5, "[[0.002,-0.005],[10.004,0.003],[9.996,10.005],[0.003,9.998],[0.002,-0.005]]"), 0, 40,
      0);
}
END_TEST

/* The shore has a vertex that the line leaves out, either near to the line or far from it. */
START_TEST(boundary_with_more_vertices) {
  geo_case it = begin(POLYGON("[[[0,0],[10,0],[10.004,4],[10.005,6],[10,10],[0,10]]]")
                          LINE(5, "[[10,0],[10,10]]"));
  ck_assert_double_eq_tol(length_of(&it, 5), 10, 1e-3);
  ck_assert(has_note(it.shapes, "a line runs along the boundary"));
  geo_end(&it);
  it = begin(POLYGON("[[[0,0],[10,0],[11,5],[10,10],[0,10]]]") LINE(5, "[[10,0],[10,10]]"));
  ck_assert_double_eq_tol(length_of(&it, 1), 30 + 2 * sqrt(26), 1e-9);
  ck_assert_double_eq_tol(length_of(&it, 5), 10, 1e-9); /* as an inner curve */
  ck_assert(!has_note(it.shapes, "along the boundary"));
  ck_assert_int_eq(noted(it.shapes, PNPBS_GEO_NOTE_LINES_ALONG_BOUNDARY), -1);
  geo_end(&it);
}
END_TEST

START_TEST(inner_curves_stay) {
  expect_lengths(LINE(5, "[[2,2],[8,2]]"), 40, 6, 1);
  expect_lengths(LINE(5, "[[0,5],[10,5]]"), 40, 10, 1);
  /* The line is beside the boundary, at a distance larger than the tolerance. */
  expect_lengths(LINE(5, "[[9.95,2],[9.95,8]]"), 40, 6, 1);
  /* One part of the line follows the boundary, with common vertices, and the other one leads away
   * from it. */
  expect_lengths(LINE(5, "[[10,0],[10,10],[5,5]]"), 30, 10 + sqrt(50), 1);
}
END_TEST

/* Two lines meet, or coincide. */
START_TEST(several_lines) {
  geo_case it = begin(SEA LINE(5, "[[10,0],[10,4.5]]") LINE(6, "[[10,4.5],[10,10]]")
                          LINE(7, "[[10.001,9.997],[6,10]]"));
  ck_assert_double_eq_tol(length_of(&it, 5), 4.5, 1e-9);
  ck_assert_double_eq_tol(length_of(&it, 6), 5.5, 0.01);
  ck_assert_double_eq_tol(length_of(&it, 7), 4, 0.01);
  ck_assert_double_eq_tol(length_of(&it, 1), 26, 0.01);
  geo_end(&it);
  it = begin(SEA LINE(5, "[[10,0],[10,10]]") LINE(6, "[[10,0],[10,10]]"));
  ck_assert_double_eq_tol(length_of(&it, 5), 10, 1e-9);
  ck_assert(has_note(it.shapes, "lines left out: 1 segments"));
  ck_assert_int_eq(noted(it.shapes, PNPBS_GEO_NOTE_LINES_LEFT_OUT), 1);
  geo_end(&it);
}
END_TEST

/* One line follows the boundary of two polygons across their border, and another one follows their
 * common edge. */
START_TEST(along_neighbours) {
  geo_case it =
      begin(POLYGON("[[[0,0],[5,0],[5,10],[0,10]]]") "," POLYGON("[[[5,0],[10,0],[10,10],[5,10]]]")
                LINE(5, "[[0.001,0.003],[10,-0.004]]") LINE(6, "[[5,0],[5,10]]"));
  ck_assert_double_eq_tol(length_of(&it, 5), 10, 1e-9);
  ck_assert_double_eq_tol(length_of(&it, 6), 10, 1e-9);
  ck_assert_double_eq_tol(length_of(&it, 1), 30, 1e-9);
  geo_end(&it);
}
END_TEST

/* A coast and an open boundary close around an island. */
START_TEST(lines_around_an_island) {
  geo_case it = begin(POLYGON("[[[4,4],[6,4],[6,6],[4,6]]]") LINE(2, "[[0,0],[10,0],[10,10]]")
                          LINE(5, "[[10,10],[0,10],[0,0]]"));
  ck_assert_double_eq_tol(geo_area(&it), 96, 1e-9);
  ck_assert_double_eq_tol(length_of(&it, 1), 8, 1e-9);
  ck_assert_double_eq_tol(length_of(&it, 2), 20, 1e-9);
  ck_assert_double_eq_tol(length_of(&it, 5), 20, 1e-9);
  geo_end(&it);
  /* A closed line in the sea, beside an island or in a polygon, remains an inner curve. */
  it = begin(SEA LINE(5, "[[2,2],[4,2],[4,4],[2,2]]"));
  ck_assert_double_eq_tol(geo_area(&it), 100, 1e-9);
  geo_end(&it);
}
END_TEST

TEST_SUITE(test_open_boundaries) {
  Suite* suite = suite_create("lines along shores");
  TCase* cases = tcase_create("all");
  tcase_add_test(cases, same_vertices);
  tcase_add_test(cases, parts_of_segments);
  tcase_add_test(cases, near_the_boundary);
  tcase_add_test(cases, boundary_with_more_vertices);
  tcase_add_test(cases, inner_curves_stay);
  tcase_add_test(cases, several_lines);
  tcase_add_test(cases, along_neighbours);
  tcase_add_test(cases, lines_around_an_island);
  suite_add_tcase(suite, cases);
  return run_suite(suite);
}
