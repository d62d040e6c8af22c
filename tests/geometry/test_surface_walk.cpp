// SPDX-License-Identifier: BSD-3-Clause
// Walks on surfaces: straight in the plane and on developable surfaces, great circles on a ball.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "core/quick_assert.hpp"
#include "core/random.hpp"
#include "domain/volume/surface_walk.hpp"
#include "geometry/volume/triangles.hpp"
#include "run_suite.hpp"
#include "surface_case.hpp"

using pnpbs::Surface;
using pnpbs::SurfacePoint;
using space_shapes::Mesh;
using space_shapes::P;
using space_shapes::Shape;
using space_shapes::SurfaceCase;

namespace {

std::int32_t any_facet(const SurfaceCase& c, Random& random) {
  return static_cast<std::int32_t>(random.below(c.facet_count()));
}

// Maps a point of one surface to another one with the same triangles.
P carried_over(const SurfaceCase& from, const SurfacePoint& at, const SurfaceCase& to) {
  const auto [v, w] =
      pnpbs::nearest_triangle_point(from.surface.corners(at.facet), at.position).along;
  return to.point(at.facet, v, w);
}

// A strip around three quarters of a prism, and the same strip unrolled.
constexpr int kSides = 40;
constexpr double kSide = 0.25, kHeight = 4;
Shape unrolled() { return space_shapes::sheet(kSides, 16, kSides * kSide, kHeight); }
Shape prism() {
  Shape shape = unrolled();
  for (P& x : shape.nodes) {
    const double turn = 1.5 * space_shapes::pi / kSides;
    const double radius = 0.5 * kSide / std::sin(0.5 * turn), angle = turn * x[0] / kSide;
    x = {radius * std::cos(angle), radius * std::sin(angle), x[1]};
  }
  return shape;
}

START_TEST(test_straight_on_a_flat_sheet) {
  const SurfaceCase flat(unrolled().mesh());
  Random random(1);
  for (int n = 0; n < 2000; ++n) {
    const std::int32_t f = any_facet(flat, random);
    const SurfacePoint from = flat.centre(f);
    const P move{random.between(-3, 3), random.between(-1, 1), random.between(-1, 1)};
    const SurfacePoint end = walk(flat.surface, from, move);
    // The walk ends where the straight line leaves the sheet.
    double part = 1;
    const double size[2] = {kSides * kSide, kHeight};
    for (const std::size_t k : {0, 1}) {
      if (move[k] > 0) part = std::min(part, (size[k] - from.position[k]) / move[k]);
      if (move[k] < 0) part = std::min(part, -from.position[k] / move[k]);
    }
    const P expected{from.position[0] + part * move[0], from.position[1] + part * move[1], 0};
    quick_assert(pnpbs::distance<3>(end.position, expected) < 1e-12);
    quick_assert(pnpbs::distance<3>(pnpbs::nearest_on(flat.surface.corners(end.facet), expected),
                                    expected) < 1e-12);
  }
}
END_TEST

START_TEST(test_unrolls_a_prism) {
  const SurfaceCase flat(unrolled().mesh()), bent(space_shapes::turned(prism(), 0.3).mesh());
  ck_assert_int_eq(bent.features.patches, 1);
  Random random(2);
  for (int n = 0; n < 2000; ++n) {
    const std::int32_t f = any_facet(flat, random);
    const P a = flat.point(f, 0.3, 0.4), move{random.between(-8, 8), random.between(-2, 2), 0};
    // The same direction in the facet of the prism.
    const auto [o, u, v] = flat.surface.corners(f);
    const auto [p, q, r] = bent.surface.corners(f);
    const P ou = pnpbs::difference(u, o), ov = pnpbs::difference(v, o);
    const double area = ou[0] * ov[1] - ou[1] * ov[0];
    const double along_u = (move[0] * ov[1] - move[1] * ov[0]) / area;
    const double along_v = (ou[0] * move[1] - ou[1] * move[0]) / area;
    const P bent_move = pnpbs::shifted(pnpbs::shifted({}, along_u, pnpbs::difference(q, p)),
                                       along_v, pnpbs::difference(r, p));
    const SurfacePoint end = walk(flat.surface, {f, a}, move);
    const SurfacePoint bent_end = walk(bent.surface, {f, bent.point(f, 0.3, 0.4)}, bent_move);
    quick_assert(pnpbs::distance<3>(bent_end.position, carried_over(flat, end, bent)) < 1e-11);
  }
}
END_TEST

// Returns the largest distance between the ends of walks on a ball and of great circles, over the
// edge length.
double great_circle_error(int cuts) {
  const SurfaceCase ball(space_shapes::ball(cuts).mesh());
  const auto [a, b, c] = ball.surface.corners(0);
  const double edge = pnpbs::distance<3>(a, b);
  Random random(3);
  double worst = 0;
  for (int n = 0; n < 300; ++n) {
    const SurfacePoint from = ball.centre(any_facet(ball, random));
    const P out = pnpbs::unit_vector(from.position);
    const P way = pnpbs::unit_vector(pnpbs::part_across(
        {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)}, out));
    const double length = random.between(0.1, 1.5);
    const SurfacePoint end = walk(ball.surface, from, pnpbs::shifted({}, length, way));
    const P expected =
        pnpbs::shifted(pnpbs::shifted({}, std::cos(length), out), std::sin(length), way);
    worst = std::max(worst, pnpbs::distance<3>(end.position, expected));
    quick_assert(
        pnpbs::distance<3>(pnpbs::nearest_on(ball.surface.corners(end.facet), end.position),
                           end.position) < 1e-15);
  }
  return worst / edge;
}

START_TEST(test_great_circles) {
  const double coarse = great_circle_error(4), fine = great_circle_error(6);
  ck_assert_double_lt(coarse, 0.25);
  ck_assert_double_lt(fine, 0.25);
}
END_TEST

START_TEST(test_stops_at_features) {
  const SurfaceCase cube(space_shapes::cube(4).mesh());
  for (std::int32_t f = 0; f < cube.facet_count(); ++f) {
    const SurfacePoint from = cube.centre(f);
    const P& normal = cube.surface.normal(f);
    // A move along an axis in the face, far beyond its edge, with a component along the normal.
    const std::size_t k = normal[0] == 0 ? 0 : 1;
    P move{};
    move[k] = 7;
    SurfacePoint end = walk(cube.surface, from, pnpbs::shifted(move, 3, normal));
    P expected = from.position;
    expected[k] = 1;
    quick_assert(pnpbs::distance<3>(end.position, expected) < 1e-14);
    quick_assert(cube.surface.patch(end.facet) == cube.surface.patch(f));
  }
}
END_TEST

// Walks through nodes of the mesh and along its edges.
START_TEST(test_ways_through_nodes) {
  const SurfaceCase flat(space_shapes::sheet(8, 8, 8, 8).mesh());
  for (std::int32_t f = 0; f < flat.facet_count(); ++f)
    for (const P& from : flat.surface.corners(f))
      for (const double x : {-1.0, 0.0, 1.0, 2.0})
        for (const double y : {-1.0, 0.0, 1.0, 2.0}) {
          const P to{from[0] + x, from[1] + y, 0};
          if (std::min(to[0], to[1]) < 0 || std::max(to[0], to[1]) > 8) continue;
          // A walk may stop where it touches the border.
          if (std::min(from[0], from[1]) == 0 || std::max(from[0], from[1]) == 8) continue;
          const SurfacePoint end = walk(flat.surface, {f, from}, {x, y, 0});
          quick_assert(pnpbs::distance<3>(end.position, to) < 1e-14);
        }
}
END_TEST

// The ball is convex: from outside, each descent leads to the unique nearest point.
START_TEST(test_pull_back) {
  const SurfaceCase ball(space_shapes::ball(3).mesh());
  Random random(4);
  for (int n = 0; n < 500; ++n) {
    const P direction =
        pnpbs::unit_vector({random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)});
    const P x = pnpbs::shifted({}, random.between(1, 1.2), direction);
    double min = std::numeric_limits<double>::infinity();
    for (std::int32_t f = 0; f < ball.facet_count(); ++f)
      min = std::min(min, pnpbs::distance<3>(pnpbs::nearest_on(ball.surface.corners(f), x), x));
    const auto start = any_facet(ball, random);
    const SurfacePoint found = pull_back(ball.surface, x, start);
    ck_assert_double_eq_tol(pnpbs::distance<3>(found.position, x), min, 1e-14);
    quick_assert(pnpbs::nearest_on(ball.surface.corners(found.facet), x) == found.position);
  }
}
END_TEST

// The point stays in the sheet where it began, although another sheet is nearer.
START_TEST(test_pull_back_stays_in_its_sheet) {
  Shape two = space_shapes::sheet(6, 6, 1, 1);
  const Shape one = two;
  for (const P& x : one.nodes) two.node({x[0], x[1], 0.01});
  for (std::array<std::int32_t, 3> t : one.triangles) {
    for (std::int32_t& node : t) node += static_cast<std::int32_t>(one.nodes.size());
    two.triangles.push_back(t);
  }
  const SurfaceCase sheets(two.mesh());
  ck_assert_int_eq(sheets.features.patches, 2);
  for (const std::int32_t start : {0, 72}) {
    const SurfacePoint found =
        pull_back(sheets.surface, {0.81, 0.72, start == 0 ? 0.01 : 0}, start);
    quick_assert(pnpbs::distance<3>(found.position, {0.81, 0.72, start == 0 ? 0 : 0.01}) < 1e-15);
  }
}
END_TEST

}  // namespace

TEST_SUITE(test_surface_walk) {
  return run_suite("surface_walk",
                   {test_straight_on_a_flat_sheet, test_unrolls_a_prism, test_great_circles,
                    test_stops_at_features, test_ways_through_nodes, test_pull_back,
                    test_pull_back_stays_in_its_sheet});
}
