// SPDX-License-Identifier: BSD-3-Clause
// Arcs, areas and circles on the unit sphere against known values, also for small ones, and the
// rings of neighbours and triangles around a node.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/space_vectors.hpp"
#include "cgrid/star_rings.hpp"
#include "quick_assert.hpp"
#include "random.hpp"
#include "run_kernel_suite.hpp"
#include "sphere/sphere_geometry.hpp"

using pnpbs::Point;

namespace {

constexpr double kPi = std::numbers::pi;

Point<3> on_unit_sphere(Random& random) {
  const double z = random.between(-1, 1), turn = random.between(-kPi, kPi);
  const double across = std::sqrt(1 - z * z);
  return {across * std::cos(turn), across * std::sin(turn), z};
}

// Returns the point at the distance `way` from x, in the direction given by an angle.
Point<3> beside(const Point<3>& x, double way, double angle) {
  const Point<3> any = std::fabs(x[2]) < 0.9 ? Point<3>{0, 0, 1} : Point<3>{1, 0, 0};
  const Point<3> u = pnpbs::unit_vector(pnpbs::cross(x, any)), v = pnpbs::cross(x, u);
  Point<3> y;
  for (std::size_t k = 0; k < 3; ++k)
    y[k] = std::cos(way) * x[k] + std::sin(way) * (std::cos(angle) * u[k] + std::sin(angle) * v[k]);
  return pnpbs::unit_vector(y);
}

}  // namespace

START_TEST(arcs_and_areas) {
  const Point<3> x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  quick_assert(std::fabs(pnpbs::arc(x, y) - kPi / 2) < 1e-15);
  quick_assert(pnpbs::arc(x, {-1, 0, 0}) == kPi);
  quick_assert(std::fabs(pnpbs::signed_area(x, y, z) - kPi / 2) < 1e-15);
  quick_assert(std::fabs(pnpbs::signed_area(x, z, y) + kPi / 2) < 1e-15);
  // Half of a thin lune from pole to pole.
  const double turn = 1e-3;
  const Point<3> beside_x{std::cos(turn), std::sin(turn), 0};
  quick_assert(std::fabs(pnpbs::signed_area(x, beside_x, z) / turn - 1) < 1e-12);
  Random random(2);
  for (int k = 0; k < 1000; ++k) {
    const Point<3> a = on_unit_sphere(random);
    const double way = std::pow(10, random.between(-6, -3)), at = random.between(0, 6);
    const Point<3> b = beside(a, way, at), c = beside(a, way, at + kPi / 2);
    quick_assert(std::fabs(pnpbs::arc(a, b) / way - 1) < 1e-9);
    quick_assert(std::fabs(pnpbs::signed_area(a, b, c) / (0.5 * way * way) - 1) < 1e-5);
  }
}
END_TEST

// The error is that of the corners, not that error over the size of the triangle.
START_TEST(circles_go_through_the_corners) {
  Random random(3);
  for (int k = 0; k < 1000; ++k) {
    const Point<3> centre = on_unit_sphere(random);
    const double way = std::pow(10, random.between(-5, 0)), at = random.between(0, 6);
    const Point<3> found = pnpbs::circumcentre(beside(centre, way, at), beside(centre, way, at + 2),
                                               beside(centre, way, at + 4));
    quick_assert(pnpbs::distance<3>(found, centre) < 3e-15);
  }
}
END_TEST

START_TEST(angles_to_the_east) {
  const Point<3> at{std::cos(0.7), 0, std::sin(0.7)};  // in the northern hemisphere
  const Point<3> north{-std::sin(0.7), 0, std::cos(0.7)};
  for (double angle = -3; angle < 3.1; angle += 0.5) {
    const Point<3> way{std::sin(angle) * north[0], std::cos(angle), std::sin(angle) * north[2]};
    const double found =
        pnpbs::angle_to_east(at, pnpbs::shifted(at, -1e-3, way), pnpbs::shifted(at, 1e-3, way));
    quick_assert(std::fabs(found - angle) < 1e-12);
  }
}
END_TEST

// A hexagon of triangles in any order and with rotated corners, and one without the last triangle.
START_TEST(rings_are_in_order) {
  const std::vector<std::int64_t> ids{50, 7, 9, 3, 8, 2, 6};  // node 0 is the centre
  std::vector<pnpbs::StarRings::Triangle> triangles{{4, 5, 0}, {0, 1, 2}, {6, 1, 0},
                                                    {2, 3, 0}, {0, 5, 6}, {3, 4, 0}};
  const auto neighbours = [&] {
    const pnpbs::StarRings rings(triangles, ids);
    std::vector<std::int32_t> found;
    for (std::int64_t k = rings.begin(0); k < rings.end(0); ++k) {
      found.push_back(rings.neighbour(k));
      const auto& corners = triangles[static_cast<std::size_t>(rings.triangle(k))];
      quick_assert(std::ranges::count(corners, rings.neighbour(k)) == 1);
    }
    quick_assert(rings.closed(0) == (triangles.size() == 6));
    quick_assert(!rings.closed(1));
    return found;
  };
  quick_assert((neighbours() == std::vector<std::int32_t>{5, 6, 1, 2, 3, 4}));
  triangles.pop_back();  // between 3 and 4
  quick_assert((neighbours() == std::vector<std::int32_t>{4, 5, 6, 1, 2}));
}
END_TEST

TEST_SUITE(test_sphere_cells) {
  return run_kernel_suite("sphere_cells", {arcs_and_areas, circles_go_through_the_corners,
                                           angles_to_the_east, rings_are_in_order});
}
