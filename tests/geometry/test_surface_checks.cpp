// SPDX-License-Identifier: BSD-3-Clause
// Each check of triangulated surfaces with its message, and the defects that are repaired.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "core/random.hpp"
#include "geometry/volume/welding.hpp"
#include "run_suite.hpp"
#include "triangle_soup.hpp"

using namespace soups;

namespace {

// Returns triangles by the positions of their corners, starting from the smallest one, in sorted
// order.
std::vector<std::array<P, 3>> places_of(const VolumeDomain& domain) {
  std::vector<std::array<P, 3>> places;
  for (const pnpbs::BoundaryTriangle& facet : domain.mesh().facets) {
    std::array<P, 3> corners = pnpbs::corners_of(domain.mesh(), facet);
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    places.push_back(corners);
  }
  std::sort(places.begin(), places.end());
  return places;
}

// Returns whether every edge occurs once in each direction.
bool is_closed(const pnpbs::BoundaryMesh<3>& mesh) {
  std::map<std::array<std::int32_t, 2>, int> edges;
  for (const pnpbs::BoundaryTriangle& facet : mesh.facets)
    for (int k = 0; k < 3; ++k) ++edges[{facet.nodes[k], facet.nodes[(k + 1) % 3]}];
  return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
    const auto& [a, b] = edge.first;
    const auto back = edges.find({b, a});
    return edge.second == 1 && back != edges.end() && back->second == 1;
  });
}

void check_soup(const Soup& soup, VolumeDomain& domain) {
  soup.add_to(domain);
  domain.check();
}

void expect_soup_error(const Soup& soup, std::initializer_list<const char*> parts) {
  VolumeDomain domain;
  soup.add_to(domain);
  expect_domain_error(domain, parts);
}

surfaces::Surface pierced() {
  surfaces::Surface surface = surfaces::sheared(surfaces::pierced_cube());
  surface.unit = 0x1p-6;
  return surface;
}

}  // namespace

// ---------------------------------------------------------------- welding
START_TEST(points_join_the_nearest_before_them_as_a_search_of_all_finds) {
  Random random(71);
  for (int round = 0; round < 20; ++round) {
    const double tolerance = round % 2 == 0 ? 1e-3 : 0.05;
    std::vector<P> points;
    for (int i = 0; i < 400; ++i) {
      if (i > 0 && random.below(2) == 0) {
        P x = points[static_cast<std::size_t>(random.below(i))];
        if (random.below(3) > 0)
          for (double& along : x) along += random.between(-tolerance, tolerance);
        points.push_back(x);
      } else {
        points.push_back(random.point<3>({{0, 0, 0}, {1, 1, 1}}));
      }
    }
    const std::vector<std::int32_t> joined = pnpbs::weld_points(points, tolerance);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto first = static_cast<std::size_t>(
          std::find(points.begin(), points.end(), points[i]) - points.begin());
      if (first < i) {
        ck_assert_int_eq(joined[i], joined[first]);
        continue;
      }
      std::size_t best = i;
      double least = tolerance;
      for (std::size_t j = i; j-- > 0;) {
        if (joined[j] != static_cast<std::int32_t>(j)) continue;
        const double gap = pnpbs::distance<3>(points[i], points[j]);
        if (gap <= least) best = j, least = gap;
      }
      ck_assert_int_eq(joined[i], best);
    }
  }
}
END_TEST

START_TEST(torn_surfaces_are_welded_in_silence_and_near_vertices_with_a_warning) {
  const Soup whole = soup_of(pierced());
  VolumeDomain a, b;
  check_soup(whole, a);
  check_soup(whole.torn(), b);
  ck_assert(a.warnings().empty() && b.warnings().empty());
  ck_assert(places_of(a) == places_of(b));
  ck_assert_uint_eq(b.mesh().nodes.size(), whole.vertices());
  ck_assert(is_closed(b.mesh()));

  Soup near = whole.torn();
  near.xyz.back() += 1e-12;  // the last vertex
  VolumeDomain c;
  check_soup(near, c);
  ck_assert(warns(c, "1 vertex lies within"));
  ck_assert(warns(c, "vertex " + std::to_string(near.vertices() - 1) + " of surface 0"));
  ck_assert(places_of(c) == places_of(a));
}
END_TEST

// ---------------------------------------------------------------- thin triangles, duplicates
START_TEST(triangles_without_area_go_and_leave_the_surface_closed) {
  // One edge has a vertex at its midpoint on one side only; a triangle without area closes the gap.
  Soup soup = unit_tetrahedron();
  soup.corners = {0, 2, 1, 0, 4, 3, 4, 1, 3, 1, 2, 3, 2, 0, 3, 0, 1, 4, 3, 3, 2};
  soup.tags.assign(7, 1);
  soup.vertex(0.25, 0, 0);
  VolumeDomain domain;
  check_soup(soup, domain);
  ck_assert(warns(
      domain, "2 triangles have a negligible area and are left out; the first is triangle 5 of"));
  ck_assert(is_closed(domain.mesh()));
  ck_assert_uint_eq(domain.mesh().facets.size(), 6);
  expect_near(domain.volume(), 1.0 / 6, 1e-15);

  // Several vertices on one line, with nested thin triangles, some slightly off the line.
  Soup strip = unit_tetrahedron();
  for (int i = 1; i < 8; ++i) strip.vertex(i / 8.0, i % 2 == 0 ? 1e-11 : 0, 0);  // 4 .. 10
  strip.corners = {0, 2, 1, 1, 2, 3, 2, 0, 3};
  const std::vector<std::int64_t> line{0, 4, 5, 6, 7, 8, 9, 10, 1};
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    strip.corners.insert(strip.corners.end(), {line[i], line[i + 1], 3});
  const std::vector<std::int64_t> thin{0, 1, 7, 0, 7, 5, 0, 5, 4, 5, 7,
                                       6, 7, 1, 9, 7, 9, 8, 9, 1, 10};
  strip.corners.insert(strip.corners.end(), thin.begin(), thin.end());
  strip.tags.assign(strip.corners.size() / 3, 1);
  VolumeDomain other;
  check_soup(strip, other);
  ck_assert(warns(other, "7 triangles have a negligible area"));
  ck_assert(is_closed(other.mesh()));
  ck_assert_uint_eq(other.mesh().facets.size(), 18);
  expect_near(other.volume(), 1.0 / 6, 1e-9);
}
END_TEST

START_TEST(edges_split_on_one_side_stay_closed_by_triangles_without_area) {
  Random random(12);
  for (int round = 0; round < 20; ++round) {
    // The vertices are exact up to the last digits of double or single precision.
    const double off = round < 10 ? 1e-10 : 1e-5;
    Soup soup = soup_of(surfaces::sphere(1, 600));
    VolumeDomain reference;
    check_soup(soup, reference);
    for (int split = 0; split < (round < 10 ? 100 : 20); ++split) {
      const std::int64_t t = random.below(soup.triangles()), k = random.below(3);
      const std::int64_t a = soup.corners[3 * t + k], b = soup.corners[3 * t + (k + 1) % 3],
                         c = soup.corners[3 * t + (k + 2) % 3];
      const double along = random.between(0.1, 0.9);
      std::array<double, 3> x;
      for (int i = 0; i < 3; ++i)
        x[i] = (1 - along) * soup.xyz[3 * a + i] + along * soup.xyz[3 * b + i] +
               random.between(-off, off);
      const std::int64_t middle = soup.vertex(x[0], x[1], x[2]);
      soup.corners[3 * t + (k + 1) % 3] = middle;
      soup.triangle(middle, b, c);
      soup.triangle(a, b, middle);
    }
    VolumeDomain domain;
    check_soup(soup, domain);
    ck_assert(warns(domain, "triangles have a negligible area"));
    ck_assert(is_closed(domain.mesh()));
    ck_assert_uint_eq(domain.mesh().nodes.size(), soup.vertices());
    ck_assert_uint_eq(domain.mesh().facets.size(), 2 * soup.vertices() - 4);
    expect_near(domain.volume(), reference.volume(), round < 10 ? 1e-9 : 1e-7);
    expect_near(domain.area(), reference.area(), round < 10 ? 1e-9 : 1e-7);
  }
}
END_TEST

START_TEST(flat_triangles_folded_over_by_rounding_are_mended) {
  // A flat triangle in the bottom, at the edge from 1 to 2, is turned over by a vertex slightly
  // beyond that edge.
  for (const double off : {-1e-7, 1e-7}) {
    Soup soup = unit_tetrahedron();
    soup.vertex(0.5 + off, 0.5 + off, 0);
    soup.corners = {0, 2, 1, 1, 2, 4, 0, 1, 3, 1, 4, 3, 4, 2, 3, 2, 0, 3};
    soup.tags.assign(6, 1);
    VolumeDomain domain;
    check_soup(soup, domain);
    ck_assert(warns(domain, "1 triangle has a negligible area"));
    ck_assert(is_closed(domain.mesh()));
    ck_assert_uint_eq(domain.mesh().facets.size(), 6);
    expect_near(domain.volume(), 1.0 / 6, 1e-6);
  }
}
END_TEST

START_TEST(triangles_given_twice_count_once) {
  Soup soup = unit_tetrahedron();
  soup.triangle(1, 3, 2);
  soup.triangle(2, 3, 1);
  VolumeDomain domain;
  check_soup(soup, domain);
  ck_assert(warns(domain,
                  "2 triangles are given twice and left out; the first is triangle 4 of "
                  "surface 0, which has the corners of triangle 2"));
  ck_assert_uint_eq(domain.mesh().facets.size(), 4);

  VolumeDomain two;
  two.add_box({0, 0, 0}, {1, 1, 1}, 1);
  two.add_box({0, 0, 0}, {1, 1, 1}, 1);
  expect_domain_error(two, {"triangle 0 of box 0 and triangle 0 of box 1 lie on each other at (0"});
}
END_TEST

START_TEST(a_surface_too_small_for_the_domain_is_refused) {
  VolumeDomain domain;
  domain.add_box({0, 0, 0}, {1, 1, 1}, 1);
  unit_tetrahedron().add_to(domain);
  domain.add_ball({0.5, 0.5, 0.5}, 1e-11, 1);
  expect_domain_error(domain, {"all triangles of ball 0 are smaller than 1e-09"});
}
END_TEST

// ---------------------------------------------------------------- closed and of two sides
START_TEST(open_seams_are_told_with_triangle_vertices_and_place) {
  Soup soup = soup_of(surfaces::sphere(2, 600));
  soup.corners.resize(soup.corners.size() - 3);
  soup.tags.pop_back();
  expect_soup_error(soup, {"the boundary is not closed: no other triangle joins triangle",
                           "of surface 0 at its edge from vertex", "there are 3 such edges"});

  Soup lone = unit_tetrahedron();
  lone.corners.resize(9);
  lone.tags.resize(3);
  expect_soup_error(lone, {"triangle 0 of surface 0 at its edge from vertex 0 of surface 0 (0, 0, "
                           "0) to vertex 2 of surface 0 (0, 1, 0)"});
}
END_TEST

START_TEST(edges_of_more_than_two_triangles_are_refused) {
  Soup soup = unit_tetrahedron();
  soup.vertex(-1, -1, 0);
  soup.vertex(-1, -1, 1);
  // Another tetrahedron at the edge from 0 to 3.
  for (const auto& t : {std::array{0, 4, 3}, {0, 3, 5}, {0, 5, 4}, {3, 4, 5}})
    soup.triangle(t[0], t[1], t[2]);
  expect_soup_error(soup, {"4 boundary triangles meet in the edge from vertex 0 of surface 0 (0, "
                           "0, 0) to vertex 3 of surface 0 (0, 0, 1)",
                           "triangle 1 of surface 0 and triangle 5", "two bodies that touch"});
  Soup fin = unit_tetrahedron();
  fin.vertex(0, 0, -1);
  for (const auto& t : {std::array{0, 1, 4}, {0, 4, 2}, {1, 2, 4}}) fin.triangle(t[0], t[1], t[2]);
  expect_soup_error(fin, {"3 boundary triangles meet in the edge"});
}
END_TEST

START_TEST(bodies_that_touch_in_a_vertex_are_told_and_taken) {
  Soup soup = unit_tetrahedron();
  soup.add(tetrahedron({0, 0, 0}, {-1, 0, 0}, {0, 0, -1}, {0, -1, 0}));
  VolumeDomain domain;
  check_soup(soup, domain);
  ck_assert(warns(domain,
                  "boundary surfaces touch in vertex 0 of surface 0 (0, 0, 0), as triangle 0 of "
                  "surface 0 and triangle 4 of surface 0 do"));
  expect_near(domain.volume(), 1.0 / 3, 1e-15);
  ck_assert_uint_eq(domain.mesh().nodes.size(), 7);
  // One tetrahedron lies within the other and touches its corner.
  VolumeDomain nested;
  unit_tetrahedron().add_to(nested);
  tetrahedron({0, 0, 0}, {0.25, 0.125, 0.125}, {0.125, 0.25, 0.125}, {0.125, 0.125, 0.25})
      .add_to(nested);
  nested.check();
  ck_assert(warns(nested, "boundary surfaces touch in vertex 0 of surface 0"));
  expect_near(nested.volume(), 1.0 / 6 - 1.0 / 6 * 0x1p-7, 1e-14);
}
END_TEST

// ---------------------------------------------------------------- orientation
START_TEST(triangles_turned_at_random_are_mended_to_the_same_mesh) {
  const Soup whole = soup_of(pierced());
  VolumeDomain reference;
  check_soup(whole, reference);
  Random random(5);
  for (int round = 0; round < 10; ++round) {
    Soup soup = whole;
    // Three of four triangles turned leave all of them inside out, and they are then turned again.
    const int of_four = round % 2 == 0 ? 1 : 3;
    std::int64_t turns = 0;
    for (std::int64_t t = 0; t < soup.triangles(); ++t)
      if (random.below(4) < of_four) soup.turn(t), ++turns;
    VolumeDomain domain;
    check_soup(soup, domain);
    ck_assert(
        warns(domain, "reversed to be oriented as the neighbours are; the first is triangle"));
    if (of_four == 1) ck_assert(warns(domain, std::to_string(turns) + " triangles were reversed"));
    ck_assert_int_eq(warns(domain, "inside out"), of_four == 3);
    ck_assert(places_of(domain) == places_of(reference));
    ck_assert(domain.volume() == reference.volume() && domain.area() == reference.area());
  }
}
END_TEST

START_TEST(bodies_that_are_inside_out_are_turned) {
  VolumeDomain domain;
  check_soup(unit_tetrahedron().turned(), domain);
  ck_assert(warns(domain, "oriented inside out and reversed: surface 0"));
  expect_near(domain.volume(), 1.0 / 6, 1e-15);
}
END_TEST

START_TEST(a_moebius_strip_is_refused) {
  Soup soup;
  constexpr int kPieces = 24;
  for (int i = 0; i < kPieces; ++i) {
    const double angle = 2 * 3.141592653589793 * i / kPieces;
    for (const double across : {-0.3, 0.3})
      soup.vertex((1 + across * std::cos(angle / 2)) * std::cos(angle),
                  (1 + across * std::cos(angle / 2)) * std::sin(angle),
                  across * std::sin(angle / 2));
  }
  for (int i = 0; i < kPieces; ++i) {
    const int a = 2 * i, b = 2 * i + 1;
    const int c = i + 1 < kPieces ? a + 2 : 1, d = i + 1 < kPieces ? b + 2 : 0;
    soup.triangle(a, c, b);
    soup.triangle(b, c, d);
  }
  VolumeDomain domain;
  domain.add_box({-2, -2, -2}, {2, 2, 2}, 1);
  soup.add_to(domain, SurfaceRole::inner);
  expect_domain_error(
      domain, {"the surface has one side only, like a Moebius strip", "of surface 0", "at vertex"});
}
END_TEST

// ---------------------------------------------------------------- crossings
START_TEST(crossing_surfaces_are_told_with_both_triangles_and_the_place) {
  VolumeDomain domain;
  domain.add_box({0, 0, 0}, {1, 1, 1}, 1);
  tetrahedron({0.5, 0.5, 0.5}, {0.6, 0.5, 0.5}, {0.5, 0.6, 0.5}, {0.5, 0.5, 3}).add_to(domain);
  expect_domain_error(
      domain, {"of box 0 and triangle", "of surface 0 cross at (0.5", ", 1)", "\ntriangle"});
}
END_TEST

START_TEST(surfaces_that_lie_on_each_other_or_touch_are_told) {
  VolumeDomain domain;
  domain.add_box({0, 0, 0}, {1, 1, 1}, 1);
  domain.add_box({0.5, 0.25, 0.25}, {1, 0.75, 0.75}, 1);
  expect_domain_error(domain, {"of box 0 and triangle", "of box 1 lie on each other at (1, "});
  VolumeDomain touching;
  touching.add_box({0, 0, 0}, {1, 1, 1}, 1);
  tetrahedron({1, 0.25, 0.5}, {0.5, 0.2, 0.2}, {0.5, 0.7, 0.2}, {0.5, 0.2, 0.7}).add_to(touching);
  expect_domain_error(touching, {"of box 0 and triangle 0 of surface 0 touch at (1, 0.25, 0.5)"});
}
END_TEST

// Outside, bodies may touch: they become regions of one.
START_TEST(bodies_that_touch_outside_are_joined) {
  VolumeDomain domain;
  domain.add_box({0, 0, 0}, {1, 1, 1}, 1);
  domain.add_box({1, 0.25, 0.25}, {2, 0.75, 0.75}, 1);
  domain.check();
  ck_assert_double_eq_tol(domain.volume(), 1.25, 1e-15);
  ck_assert_double_eq_tol(domain.area(), 6 + 2, 1e-14);
  ck_assert_ptr_nonnull(domain.regions());
  VolumeDomain equal_faces;
  equal_faces.add_box({0, 0, 0}, {1, 1, 1}, 1);
  equal_faces.add_box({1, 0, 0}, {2, 1, 1}, 1);
  equal_faces.check();
  ck_assert_double_eq_tol(equal_faces.volume(), 2, 1e-15);
  ck_assert_double_eq_tol(equal_faces.area(), 10, 1e-14);
}
END_TEST

START_TEST(neighbours_folded_over_are_told) {
  Soup soup;
  for (const P& x : {P{0, 0, 0.25}, {1, 0, 0.5}, {0, 1, 0.25}, {0.5, -1, 0.375}})
    soup.vertex(x[0], x[1], x[2]);
  soup.triangle(0, 1, 2);
  soup.triangle(1, 0, 3);
  for (const bool folded : {false, true}) {
    VolumeDomain domain;
    domain.add_box({-2, -2, -2}, {2, 2, 2}, 1);
    if (folded) soup.xyz[3 * 3 + 1] = 1;  // in the same plane, on the other side of the edge
    soup.add_to(domain, SurfaceRole::inner);
    if (folded)
      expect_domain_error(
          domain, {"triangle 0 of surface 0 and triangle 1 of surface 0 lie on each other at"});
    else
      domain.check();
  }
}
END_TEST

START_TEST(figures_of_eight_are_told) {
  // A pyramid whose apex is pushed down through its base.
  Soup soup;
  for (const P& x : {P{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}, {0.5, 0.5, 0.125}})
    soup.vertex(x[0], x[1], x[2]);
  for (int k = 0; k < 4; ++k) {
    soup.triangle(k, (k + 1) % 4, 4);
    soup.triangle((k + 1) % 4, k, 5);
  }
  VolumeDomain fine;
  check_soup(soup, fine);
  expect_near(fine.volume(), 0.875 / 3, 1e-15);
  soup.xyz[3 * 5] = 1.5;
  expect_soup_error(soup, {"of surface 0 and triangle", "of surface 0 cross at"});
}
END_TEST

TEST_SUITE(test_surface_checks) {
  return run_suite(
      "surface_checks",
      {points_join_the_nearest_before_them_as_a_search_of_all_finds,
       torn_surfaces_are_welded_in_silence_and_near_vertices_with_a_warning,
       triangles_without_area_go_and_leave_the_surface_closed,
       edges_split_on_one_side_stay_closed_by_triangles_without_area,
       flat_triangles_folded_over_by_rounding_are_mended, triangles_given_twice_count_once,
       a_surface_too_small_for_the_domain_is_refused,
       open_seams_are_told_with_triangle_vertices_and_place,
       edges_of_more_than_two_triangles_are_refused,
       bodies_that_touch_in_a_vertex_are_told_and_taken,
       triangles_turned_at_random_are_mended_to_the_same_mesh,
       bodies_that_are_inside_out_are_turned, a_moebius_strip_is_refused,
       crossing_surfaces_are_told_with_both_triangles_and_the_place,
       surfaces_that_lie_on_each_other_or_touch_are_told, bodies_that_touch_outside_are_joined,
       neighbours_folded_over_are_told, figures_of_eight_are_told});
}
