// SPDX-License-Identifier: BSD-3-Clause
// Contacts of triangles and segments, and the region of a point, against exact integers.
#include <array>
#include <cmath>
#include <vector>

#include "core/random.hpp"
#include "core/surfaces.hpp"
#include "geometry/volume/triangle_contacts.hpp"
#include "geometry/volume/triangles.hpp"
#include "run_suite.hpp"
#include "surfaces/nesting.hpp"
#include "surfaces/surface_checks.hpp"

using surfaces::Place;
using surfaces::Surface;
using P = pnpbs::Point<3>;

namespace {

using Corners = std::vector<Place>;  // three, or two of a segment

P point(const Place& x) {
  return {static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])};
}
pnpbs::FacetCorners<3> points(const Corners& c) { return {point(c[0]), point(c[1]), point(c[2])}; }

bool is_zero(const Place& x) { return dot(x, x) == 0; }
bool has_area(const Corners& c) { return !is_zero(cross(c[1] - c[0], c[2] - c[0])); }

Place random_place(Random& random, std::int64_t n) {
  return {random.below(n), random.below(n), random.below(n)};
}

std::vector<Place> edges(const Corners& c) {
  if (c.size() == 2) return {c[1] - c[0]};
  return {c[1] - c[0], c[2] - c[1], c[0] - c[2]};
}

// Returns whether the projections on the axis are disjoint.
bool apart(const Place& axis, const Corners& a, const Corners& b) {
  const auto range = [&](const Corners& corners) {
    auto low = dot(axis, corners[0]), high = low;
    for (const Place& x : corners)
      low = std::min(low, dot(axis, x)), high = std::max(high, dot(axis, x));
    return std::pair(low, high);
  };
  const auto [low_a, high_a] = range(a);
  const auto [low_b, high_b] = range(b);
  return high_a < low_b || high_b < low_a;
}

// Tests all possible separating axes of two flat convex bodies: the normals of each, those of an
// edge of each, and those of edges within each plane.
bool meet(const Corners& a, const Corners& b) {
  std::vector<Place> axes;
  for (const Corners* body : {&a, &b}) {
    if (body->size() < 3) continue;
    const Place normal = cross((*body)[1] - (*body)[0], (*body)[2] - (*body)[0]);
    axes.push_back(normal);
    for (const Corners* other : {&a, &b})
      for (const Place& edge : edges(*other)) axes.push_back(cross(normal, edge));
  }
  for (const Place& s : edges(a))
    for (const Place& t : edges(b)) axes.push_back(cross(s, t));
  for (const Place& axis : axes)
    if (!is_zero(axis) && apart(axis, a, b)) return false;
  return true;
}

bool cone_meets(const Place& tip, const Corners& triangle, const Corners& opposite) {
  const Corners cone{tip, tip + 1000 * (triangle[1] - tip), tip + 1000 * (triangle[2] - tip)};
  return meet(cone, opposite);
}

// Returns whether the triangles have more in common than their first `common` corners.
bool meet_beyond(const Corners& a, const Corners& b, int common) {
  if (common == 0) return meet(a, b);
  if (common == 1)  // at the common corner they are cones
    return cone_meets(a[0], a, {b[1], b[2]}) || cone_meets(a[0], b, {a[1], a[2]});
  const Place edge = a[1] - a[0], s = cross(edge, a[2] - a[0]), t = cross(edge, b[2] - a[0]);
  return is_zero(cross(s, t)) && dot(s, t) > 0;
}

}  // namespace

START_TEST(triangles_meet_as_whole_numbers_say) {
  Random random(3);
  std::array<std::array<int, 2>, 3> found{};
  for (int trial = 0; trial < 60000; ++trial) {
    const int common = trial % 3;
    const std::int64_t n = trial % 7 == 0 ? 3 : 6;
    Corners a, b;
    for (int k = 0; k < 3; ++k) {
      a.push_back(random_place(random, n));
      b.push_back(k < common ? a[static_cast<std::size_t>(k)] : random_place(random, n));
      if (trial % 5 == 0) b.back()[2] = a.back()[2] = 1;  // in one plane
    }
    if (trial % 5 == 1)  // in one plane, oblique
      for (Corners* corners : {&a, &b})
        for (Place& x : *corners) x[2] = 2 * x[0] - x[1];
    if (!has_area(a) || !has_area(b)) continue;
    bool repeated = false;  // a repeated point under two numbers is ambiguous
    for (std::size_t i = static_cast<std::size_t>(common); i < 3; ++i)
      for (const Place& x : a) repeated = repeated || is_zero(x - b[i]);
    if (common > 0 && repeated) continue;
    const bool expected = meet_beyond(a, b, common);
    std::array<std::int32_t, 3> numbers_a{0, 1, 2}, numbers_b{3, 4, 5};
    for (int k = 0; k < common; ++k) numbers_b[static_cast<std::size_t>(k)] = k;
    // Corners in any order.
    const auto turn = static_cast<std::ptrdiff_t>(random.below(3));
    std::rotate(numbers_b.begin(), numbers_b.begin() + turn, numbers_b.end());
    std::rotate(b.begin(), b.begin() + turn, b.end());
    if (trial % 2 == 0) {
      std::swap(a[1], a[2]);
      std::swap(numbers_a[1], numbers_a[2]);
    }
    const auto x = points(a), y = points(b);
    quick_assert(pnpbs::triangles_meet(x, numbers_a, y, numbers_b) == expected);
    quick_assert(pnpbs::triangles_meet(y, numbers_b, x, numbers_a) == expected);
    ++found[static_cast<std::size_t>(common)][expected ? 1 : 0];
    if (common != 0 || !expected) continue;
    const pnpbs::Contact contact = pnpbs::contact_of(x, y);
    for (const auto& triangle : {x, y})
      quick_assert(pnpbs::distance<3>(pnpbs::nearest_on(triangle, contact.place), contact.place) <
                   1e-12);
  }
  for (const auto& counts : found) ck_assert(counts[0] > 500 && counts[1] > 500);
}
END_TEST

START_TEST(segments_meet_triangles_as_whole_numbers_say) {
  Random random(4);
  std::array<int, 2> met{}, ran{};
  for (int trial = 0; trial < 40000; ++trial) {
    Corners triangle, segment;
    for (int k = 0; k < 3; ++k) triangle.push_back(random_place(random, 5));
    for (int k = 0; k < 2; ++k) segment.push_back(random_place(random, 5));
    if (trial % 3 == 0)
      for (Corners* corners : {&triangle, &segment})
        for (Place& x : *corners) x[1] = x[0] + x[2];
    if (!has_area(triangle) || is_zero(segment[1] - segment[0])) continue;
    const bool expected = meet(triangle, segment);
    const P p = point(segment[0]), q = point(segment[1]);
    quick_assert(pnpbs::segment_meets(p, q, points(triangle)) == expected);
    ++met[expected ? 1 : 0];
    if (expected) {
      const P place = pnpbs::meeting_point(p, q, points(triangle));
      quick_assert(pnpbs::distance<3>(pnpbs::nearest_on(points(triangle), place), place) < 1e-12);
    }
    // A segment from a corner of the triangle: it runs into it if it is in its plane and between
    // its edges.
    if (is_zero(segment[1] - triangle[0])) continue;
    const Place u = triangle[1] - triangle[0], v = triangle[2] - triangle[0],
                w = segment[1] - triangle[0], normal = cross(u, v);
    const bool into =
        dot(normal, w) == 0 && dot(normal, cross(u, w)) >= 0 && dot(normal, cross(w, v)) >= 0;
    quick_assert(pnpbs::segment_runs_into(q, points(triangle)) == into);
    ++ran[into ? 1 : 0];
  }
  ck_assert(met[0] > 1000 && met[1] > 1000 && ran[0] > 1000 && ran[1] > 1000);
}
END_TEST

START_TEST(a_tree_finds_the_boxes_that_meet_a_box) {
  Random random(8);
  std::vector<pnpbs::Box<3>> boxes;
  for (int i = 0; i < 500; ++i) {
    const Place low = random_place(random, 30), size = random_place(random, i % 9 == 0 ? 20 : 4);
    boxes.push_back({point(low), point(low + size)});
  }
  const pnpbs::BoxTree<3> tree(boxes);
  std::size_t found = 0;
  for (const pnpbs::Box<3>& box : boxes) {
    std::vector<std::int32_t> near, expected;
    tree.for_meeting(box, [&](std::int32_t other) { near.push_back(other); });
    std::sort(near.begin(), near.end());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      bool meets = true;
      for (std::size_t k = 0; k < 3; ++k)
        meets = meets &&
                std::max(box.low[k], boxes[i].low[k]) <= std::min(box.high[k], boxes[i].high[k]);
      if (meets) expected.push_back(static_cast<std::int32_t>(i));
    }
    ck_assert(near == expected);
    found += near.size();
  }
  ck_assert_uint_gt(found, 3 * boxes.size());
}
END_TEST

START_TEST(points_are_inside_as_whole_numbers_say) {
  Random random(9);
  for (const Surface& surface :
       {surfaces::pierced_cube(), surfaces::sheared(surfaces::pierced_cube()),
        surfaces::sphere(2, 60)}) {
    pnpbs::SurfaceSource source;
    source.name = "surface 0";
    for (const Place& x : surface.nodes) source.vertices.push_back(surface.at(x));
    source.triangles = surface.triangles;
    source.tags.assign(source.triangles.size(), 1);
    pnpbs::Triangulation all = pnpbs::join_surfaces({source});
    for (auto& triangle : all.triangles)
      if (random.below(2) == 0) triangle.turn_around();  // orientation does not matter
    const pnpbs::SurfaceEdges edges(all);
    const pnpbs::BoxTree<3> tree = pnpbs::tree_of(all);
    const pnpbs::SurfaceRegions regions(all, edges, tree);
    const std::vector<char> inside = pnpbs::inside_by_parity(all, regions);
    const pnpbs::Box<3> box = surface.bounds();
    int in = 0, out = 0;
    for (int trial = 0; trial < 3000; ++trial) {
      Place x;
      for (std::size_t k = 0; k < 3; ++k)
        x[k] = static_cast<std::int64_t>(box.low[k]) - 2 +
               random.below(static_cast<std::int64_t>(box.high[k] - box.low[k]) + 5);
      if (surfaces::on_surface(surface, x)) continue;
      const bool expected = surfaces::is_inside(surface, x);
      quick_assert((inside[static_cast<std::size_t>(regions.around(surface.at(x)))] != 0) ==
                   expected);
      ++(expected ? in : out);
    }
    ck_assert(in > 300 && out > 300);
  }
}
END_TEST

TEST_SUITE(test_triangle_contacts) {
  return run_suite(
      "triangle_contacts",
      {triangles_meet_as_whole_numbers_say, segments_meet_triangles_as_whole_numbers_say,
       a_tree_finds_the_boxes_that_meet_a_box, points_are_inside_as_whole_numbers_say});
}
