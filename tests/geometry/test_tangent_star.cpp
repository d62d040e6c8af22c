// SPDX-License-Identifier: BSD-3-Clause
// Stars within surfaces: against the Delaunay triangulation of flat patches, by all circles, and
// against the convex hull of nodes on a ball, by all planes.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include "core/quick_assert.hpp"
#include "predicates/plane.hpp"
#include "predicates/space.hpp"
#include "run_suite.hpp"
#include "surface_stars.hpp"

using space_shapes::disagreement;
using space_shapes::P;
using space_shapes::Shape;
using space_shapes::StarredSurface;
using space_shapes::StarTriangle;
using space_shapes::SurfaceCase;

namespace {

using Triangles = std::set<StarTriangle>;

// Returns the triangles that are in the stars of all three nodes.
Triangles triangles_in_all(const std::multiset<StarTriangle>& all) {
  Triangles triangles;
  for (const StarTriangle& t : all)
    if (all.count(t) == 3) triangles.insert(t);
  return triangles;
}

// Returns all triangles with edges below `reach` for which no node is on the wrong side, as given
// by wrong(i, j, k, other).
template <class Wrong>
Triangles triangles_by_search(const std::vector<P>& x, double reach, const Wrong& wrong) {
  const auto n = static_cast<std::int32_t>(x.size());
  const auto near = [&](std::int32_t i, std::int32_t j) {
    return pnpbs::distance<3>(x[static_cast<std::size_t>(i)], x[static_cast<std::size_t>(j)]) <
           reach;
  };
  Triangles triangles;
  for (std::int32_t i = 0; i < n; ++i)
    for (std::int32_t j = i + 1; j < n; ++j)
      for (std::int32_t k = i + 1; k < n; ++k) {
        if (k == j || !near(i, j) || !near(i, k) || !near(j, k)) continue;
        bool right = true;
        for (std::int32_t other = 0; other < n && right; ++other)
          right = other == i || other == j || other == k || !wrong(i, j, k, other);
        if (right) triangles.insert({i, j, k});
      }
  return triangles;
}

bool in_angle_piece(const P& x) { return x[0] < 2 || x[1] < 2; }

// Returns the sheet of 4 by 4 without its upper right quarter.
Shape angle_piece() {
  Shape shape = space_shapes::sheet(8, 8, 4, 4);
  Shape piece{shape.nodes, {}};
  for (std::size_t t = 0; t < shape.triangles.size(); ++t)
    if (in_angle_piece(shape.centroid(t))) piece.triangles.push_back(shape.triangles[t]);
  return piece;
}

// A planar patch has the Delaunay triangulation of the plane, also after a rotation in space.
START_TEST(test_flat_patch) {
  constexpr double kSpacing = 0.4;
  const SurfaceCase flat(angle_piece().mesh());
  StarredSurface before(flat, kSpacing);
  Random random(5);
  before.throw_nodes(random);
  std::vector<P> x;
  for (const space_shapes::PlacedNode& node : before.nodes) x.push_back(node.position);
  const auto at = [&](std::int32_t i) {
    const P& p = x[static_cast<std::size_t>(i)];
    return pnpbs::Point<2>{p[0], p[1]};
  };
  Triangles expected =
      triangles_by_search(x, 4 * kSpacing, [&](auto i, auto j, auto k, auto other) {
        return pnpbs::orientation(at(i), at(j), at(k)) <= 0 ||
               pnpbs::in_circle_perturbed(at(i), at(j), at(k), at(other), i, j, k, other) > 0;
      });
  std::erase_if(expected, [&](const StarTriangle& t) {
    P sum{};
    for (const std::int32_t i : t)
      sum = pnpbs::shifted(sum, 1.0 / 3, x[static_cast<std::size_t>(i)]);
    return !in_angle_piece(sum);
  });
  ck_assert_uint_gt(expected.size(), 100);

  for (const double angle : {0.0, 0.9}) {
    const SurfaceCase c(space_shapes::turned(angle_piece(), angle).mesh());
    StarredSurface after(c, kSpacing);
    Random same(5);
    after.throw_nodes(same);
    ck_assert_uint_eq(after.nodes.size(), x.size());
    const std::multiset<StarTriangle> found = after.triangles(4 * kSpacing);
    ck_assert_double_eq(disagreement(found), 0);
    quick_assert(triangles_in_all(found) == expected);
  }
}
END_TEST

// The four corners of squares lie on circles: all nodes break the ties alike.
START_TEST(test_ties_in_a_flat_patch) {
  const SurfaceCase c(space_shapes::turned(space_shapes::sheet(10, 10, 1, 1), 0.5).mesh());
  StarredSurface starred(c, 0.1);
  std::set<P> taken;
  for (const space_shapes::PlacedNode& node : starred.nodes) taken.insert(node.position);
  for (std::int32_t f = 0; f < c.facet_count(); ++f) {
    const P x = c.surface.corners(f)[0];
    const bool inner = c.surface.feature_clearance({f, x}, 1) > 0.01;
    if (inner && taken.insert(x).second) starred.add({f, x});
  }
  ck_assert_uint_eq(starred.nodes.size(), 121);
  const std::multiset<StarTriangle> found = starred.triangles(0.35);
  ck_assert_double_eq(disagreement(found), 0);
  ck_assert_uint_eq(triangles_in_all(found).size(), 200);
}
END_TEST

// The faces of the convex hull are the triangles of the stars.
START_TEST(test_ball) {
  constexpr double kSpacing = 0.35;
  const SurfaceCase c(space_shapes::ball(6).mesh());
  StarredSurface starred(c, kSpacing);
  Random random(6);
  starred.throw_nodes(random);
  std::vector<P> x;
  for (const space_shapes::PlacedNode& node : starred.nodes) x.push_back(node.position);
  const auto at = [&](std::int32_t i) { return x[static_cast<std::size_t>(i)]; };
  const Triangles expected =
      triangles_by_search(x, 3 * kSpacing, [&](auto i, auto j, auto k, auto other) {
        return pnpbs::orientation(at(i), at(j), at(k), at(other)) > 0;
      });
  ck_assert_uint_eq(expected.size(), 2 * x.size() - 4);
  const std::multiset<StarTriangle> found = starred.triangles(3 * kSpacing);
  ck_assert_double_eq(disagreement(found), 0);
  quick_assert(triangles_in_all(found) == expected);
}
END_TEST

// The triangles of all patches together triangulate a closed body: n nodes and 2 n - 4 triangles.
START_TEST(test_closed_bodies) {
  const Shape shapes[] = {space_shapes::turned(space_shapes::cube(6), 0.4),
                          space_shapes::cylinder(60, 20, 2)};
  const double spacings[] = {0.2, 0.25};
  for (const std::size_t which : {0, 1}) {
    const SurfaceCase c(shapes[which].mesh());
    StarredSurface starred(c, spacings[which]);
    Random random(7);
    starred.throw_nodes(random);
    const std::multiset<StarTriangle> found = starred.triangles(4 * spacings[which]);
    ck_assert_double_eq(disagreement(found), 0);
    ck_assert_uint_eq(triangles_in_all(found).size(), 2 * starred.nodes.size() - 4);
  }
}
END_TEST

// Most stars agree on a general surface, although neighbours may disagree.
START_TEST(test_ellipsoid) {
  Shape shape = space_shapes::ball(5);
  for (P& x : shape.nodes) x[2] *= 0.5;
  const SurfaceCase c(shape.mesh());
  StarredSurface starred(c, 0.15);
  Random random(9);
  starred.throw_nodes(random);
  const std::multiset<StarTriangle> found = starred.triangles(0.6);
  ck_assert_double_lt(disagreement(found), 0.02);
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(starred.nodes.size()); ++i)
    quick_assert(starred.star_of(i, 0.6).size() >= 3);
}
END_TEST

// A list with too small a reach proves nothing.
START_TEST(test_needs_its_reach) {
  const SurfaceCase c(space_shapes::ball(5).mesh());
  StarredSurface starred(c, 0.3);
  Random random(8);
  starred.throw_nodes(random);
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(starred.nodes.size()); ++i) {
    quick_assert(starred.star_of(i, 0.3).empty());
    quick_assert(!starred.star_of(i, 1.2).empty());
  }
}
END_TEST

}  // namespace

TEST_SUITE(test_tangent_star) {
  return run_suite("tangent_star", {test_flat_patch, test_ties_in_a_flat_patch, test_ball,
                                    test_closed_bodies, test_ellipsoid, test_needs_its_reach});
}
