// SPDX-License-Identifier: BSD-3-Clause
// Predicates of a single triangle: whether it meets a box, contains a point or touches a segment,
// and its nearest point. References are integers, clipped polygons, and sampled points.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "geometry/facet_index.hpp"
#include "random.hpp"
#include "run_kernel_suite.hpp"
#include "surfaces.hpp"

using surfaces::Place;
using surfaces::Surface;
using P = pnpbs::Point<3>;
using Corners = pnpbs::FacetCorners<3>;
using B = pnpbs::Box<3>;

namespace {

// Clips a convex polygon to the slab between two planes orthogonal to axis k.
std::vector<P> cut(const std::vector<P>& polygon, std::size_t k, double low, double high) {
  std::vector<P> rest = polygon;
  for (const double side : {1.0, -1.0}) {
    const double bound = side > 0 ? low : -high;
    std::vector<P> kept;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      const P &a = rest[i], &b = rest[(i + 1) % rest.size()];
      const double at_a = side * a[k] - bound, at_b = side * b[k] - bound;
      if (at_a >= 0) kept.push_back(a);
      if ((at_a < 0) == (at_b < 0)) continue;
      P x;
      for (std::size_t l = 0; l < 3; ++l) x[l] = a[l] + at_a / (at_a - at_b) * (b[l] - a[l]);
      x[k] = side * bound;
      kept.push_back(x);
    }
    rest = kept;
  }
  return rest;
}

bool meets(std::vector<P> polygon, const B& box) {
  for (std::size_t k = 0; k < 3; ++k) polygon = cut(polygon, k, box.low[k], box.high[k]);
  return !polygon.empty();
}

B grown(B box, double by) {
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] -= by;
    box.high[k] += by;
  }
  return box;
}

Place small_place(Random& random, std::int64_t range) {
  return {random.below(range), random.below(range), random.below(range)};
}

P point_of(const Place& x) {
  return {static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])};
}

Corners corners_of(const Surface& one) {
  return {one.at(one.corner(0, 0)), one.at(one.corner(0, 1)), one.at(one.corner(0, 2))};
}

// Returns a random triangle. Every fifth one is degenerate.
Surface some_triangle(Random& random, std::int64_t range, int trial) {
  Surface one;
  one.nodes = {small_place(random, range), small_place(random, range), small_place(random, range)};
  if (trial % 10 == 0) one.nodes[2] = one.nodes[1];
  if (trial % 10 == 5) one.nodes[2] = 2 * one.nodes[1] - one.nodes[0];
  one.triangles = {{0, 1, 2}};
  return one;
}

}  // namespace

START_TEST(triangles_and_segments_that_meet_boxes) {
  Random random(1);
  int meeting = 0, beside = 0, segments = 0;
  for (int trial = 0; trial < 40000; ++trial) {
    const double wide = trial % 2 == 0 ? 0.4 : 4;
    const P low = random.point<3>({{0, 0, 0}, {1, 1, 1}});
    const B box{low, random.point<3>({low, {low[0] + wide, low[1] + wide, low[2] + wide}})};
    const B around{{-1, -1, -1}, {2, 2, 2}};
    const P a = random.point<3>(around), b = random.point<3>(around), c = random.point<3>(around);
    const bool may_meet = pnpbs::may_meet_box({a, b, c}, box);
    if (meets({a, b, c}, grown(box, -1e-12))) {
      quick_assert(may_meet);
      ++meeting;
    } else if (!meets({a, b, c}, grown(box, 1e-9))) {
      quick_assert(!may_meet);
      ++beside;
    }
    const bool segment_may_meet = pnpbs::segment_may_meet_box(a, b, box);
    if (meets({a, b}, grown(box, -1e-12))) {
      quick_assert(segment_may_meet);
      ++segments;
    } else if (!meets({a, b}, grown(box, 1e-9))) {
      quick_assert(!segment_may_meet);
    }
  }
  ck_assert_int_gt(meeting, 4000);
  ck_assert_int_gt(beside, 4000);
  ck_assert_int_gt(segments, 2000);
}
END_TEST

// Boxes that only touch the triangle, at lattice points of triangles and far from the origin.
START_TEST(touched_boxes_are_met) {
  Random random(2);
  for (int trial = 0; trial < 20000; ++trial) {
    const Surface one = some_triangle(random, 12, trial);
    const double far = trial % 3 == 0 ? 0x1p40 : 0;
    const std::int64_t i = random.below(4), j = random.below(4 - i);
    P x;  // the barycentric coordinates are thirds
    Corners corners = corners_of(one);
    for (std::size_t k = 0; k < 3; ++k) {
      for (P& corner : corners) corner[k] = 3 * corner[k] + far;
      x[k] = static_cast<double>(i * one.nodes[0][k] + j * one.nodes[1][k] +
                                 (3 - i - j) * one.nodes[2][k]) +
             far;
    }
    B box{x, x};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t way = random.below(3);
      if (way > 0) box.high[k] += static_cast<double>(random.below(9));
      if (way > 1) box.low[k] -= static_cast<double>(random.below(9));
    }
    quick_assert(pnpbs::may_meet_box(corners, box));
    quick_assert(pnpbs::on_facet(corners, x));
  }
}
END_TEST

START_TEST(points_on_triangles) {
  Random random(3);
  int on = 0;
  for (int trial = 0; trial < 100000; ++trial) {
    const Surface one = some_triangle(random, 5, trial);
    const Place x = small_place(random, 5);
    const bool expected = surfaces::squared_gap(one, 0, x) == 0;
    quick_assert(pnpbs::on_facet(corners_of(one), point_of(x)) == expected);
    on += expected;
  }
  ck_assert_int_gt(on, 2000);
}
END_TEST

namespace {

// Returns whether a point of the segment from p to q lies on the triangle. Segments in its plane
// are tested elsewhere.
bool touches(const Surface& one, const Place& p, const Place& q) {
  const Place a = one.corner(0, 0), b = one.corner(0, 1), c = one.corner(0, 2);
  const Place normal = surfaces::cross(b - a, c - a);
  const surfaces::Wide at_p = dot(normal, p - a), at_q = dot(normal, q - a);
  if (surfaces::sign(at_p) * surfaces::sign(at_q) > 0) return false;
  if (at_p == 0 && at_q == 0) return false;
  // p + at_p / (at_p - at_q) (q - p), in units of the denominator.
  const auto over = static_cast<std::int64_t>(at_p - at_q), t = static_cast<std::int64_t>(at_p);
  Surface larger = one;
  for (Place& node : larger.nodes) node = over * node;
  return surfaces::on_triangle(larger, 0, over * p + t * (q - p));
}

}  // namespace

START_TEST(ways_that_touch_triangles) {
  Random random(4);
  int touching = 0, in_plane = 0, apart_in_plane = 0;
  for (int trial = 1; trial < 100000; ++trial) {
    if (trial % 5 == 0) continue;
    const Surface one = some_triangle(random, 6, trial);
    const Place a = one.corner(0, 0), u = one.corner(0, 1) - a, v = one.corner(0, 2) - a;
    const Place normal = surfaces::cross(u, v);
    if (dot(normal, normal) == 0) continue;
    const Place p = small_place(random, 6), q = small_place(random, 6);
    const bool may_touch = pnpbs::may_touch(point_of(p), point_of(q), corners_of(one));
    if (dot(normal, p - a) != 0 || dot(normal, q - a) != 0) {
      const bool expected = touches(one, p, q);
      quick_assert(may_touch == expected);
      touching += expected;
    }
    // Segments in the plane of the triangle: the answer is never no if a sampled point is on the
    // triangle.
    const Place from = 4 * a + (random.below(9) - 4) * u + (random.below(9) - 4) * v,
                to = 4 * a + (random.below(9) - 4) * u + (random.below(9) - 4) * v;
    Surface larger = one;
    for (Place& node : larger.nodes) node = 4 * node;
    const bool may_touch_in_plane =
        pnpbs::may_touch(point_of(from), point_of(to), corners_of(larger));
    for (Place& node : larger.nodes) node = 12 * node;
    bool on = false;
    for (std::int64_t t = 0; t <= 12; ++t)
      on = on || surfaces::on_triangle(larger, 0, (12 - t) * from + t * to);
    if (on) quick_assert(may_touch_in_plane);
    in_plane += on;
    apart_in_plane += !may_touch_in_plane;
  }
  ck_assert_int_gt(touching, 5000);
  ck_assert_int_gt(in_plane, 5000);
  ck_assert_int_gt(apart_in_plane, 5000);
}
END_TEST

// Fixed nodes and inner curves are degenerate triangles.
START_TEST(ways_past_points_and_segments) {
  const P p{0, 0, 0}, q{4, 4, 4};
  const Corners on_way{P{1, 1, 1}, P{1, 1, 1}, P{1, 1, 1}};
  quick_assert(pnpbs::may_touch(p, q, on_way) && !pnpbs::crosses(p, q, on_way));
  quick_assert(!pnpbs::may_touch(p, q, {P{1, 1, 2}, P{1, 1, 2}, P{1, 1, 2}}));
  quick_assert(pnpbs::may_touch(p, q, {P{0, 2, 2}, P{4, 2, 2}, P{4, 2, 2}}));
  quick_assert(!pnpbs::may_touch(p, q, {P{0, 2, 3}, P{4, 2, 3}, P{4, 2, 3}}));
  quick_assert(!pnpbs::may_touch(p, q, {P{0, 0, 1}, P{3, 3, 4}, P{3, 3, 4}}));  // beside it
  quick_assert(pnpbs::nearest_on(on_way, {1, 1, 4}) == on_way[0]);
  quick_assert(pnpbs::nearest_on({P{0, 0, 0}, P{4, 0, 0}, P{4, 0, 0}}, {3, 1, 1}) == (P{3, 0, 0}));
}
END_TEST

START_TEST(nearest_points_of_single_triangles) {
  Random random(5);
  for (int trial = 0; trial < 50000; ++trial) {
    const Surface one = some_triangle(random, 1000, trial);
    const Place x = small_place(random, 1000);
    const double expected = static_cast<double>(std::sqrt(surfaces::squared_gap(one, 0, x)));
    const P nearest = pnpbs::nearest_on(corners_of(one), point_of(x));
    ck_assert_double_eq_tol(pnpbs::distance<3>(nearest, point_of(x)), expected, 1e-9);
    // The point lies on the triangle, and no other point of it is nearer.
    const auto& [a, b, c] = corners_of(one);
    for (int other = 0; other < 10; ++other) {
      const double u = random.between(0, 1), v = random.between(0, 1 - u);
      P y;
      for (std::size_t k = 0; k < 3; ++k) y[k] = a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k]);
      quick_assert(pnpbs::distance<3>(y, point_of(x)) >=
                   pnpbs::distance<3>(nearest, point_of(x)) - 1e-9);
    }
    ck_assert_double_le(pnpbs::distance<3>(pnpbs::nearest_on(corners_of(one), nearest), nearest),
                        1e-9);
  }
}
END_TEST

// Facets skipped by a block do not touch the segment, and most distant facets are skipped.
START_TEST(blocks_off_the_way) {
  Surface s = surfaces::sphere(4, 900);
  std::vector<Corners> facets;
  for (std::size_t t = 0; t < s.triangles.size(); ++t)
    facets.push_back({s.at(s.corner(t, 0)), s.at(s.corner(t, 1)), s.at(s.corner(t, 2))});
  pnpbs::FacetBlocks<3> blocks;
  blocks.build(facets);
  Random random(6);
  std::size_t passed = 0, asked = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const P x = random.point<3>({{-900, -900, -900}, {900, 900, 900}});
    P y = x;
    for (double& along : y) along += random.between(-300, 300);
    std::vector<std::int32_t> row;  // all facets except for some gaps
    for (std::int32_t f = 0; f < std::ssize(facets); ++f)
      if (f % 700 != trial) row.push_back(f);
    for (std::size_t k = 0; k < row.size(); ++k) {
      const std::size_t off = blocks.facets_off_segment(row, k, x, y);
      for (std::size_t f = k; f < k + off; ++f)
        quick_assert(!pnpbs::may_touch(x, y, facets[static_cast<std::size_t>(row[f])]));
      passed += off;
      if (off > 0) k += off - 1;
    }
    asked += row.size();
  }
  ck_assert_uint_gt(passed, asked * 8 / 10);
  ck_assert_uint_lt(passed, asked);
}
END_TEST

TEST_SUITE(test_volume_triangles) {
  return run_kernel_suite(
      "volume_triangles",
      {triangles_and_segments_that_meet_boxes, touched_boxes_are_met, points_on_triangles,
       ways_that_touch_triangles, ways_past_points_and_segments, nearest_points_of_single_triangles,
       blocks_off_the_way});
}
