// SPDX-License-Identifier: BSD-3-Clause
// Measures of tetrahedra against known values.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/run_suite.hpp"
#include "quality/volume/tetrahedron_quality.hpp"
#include "quick_assert.hpp"
#include "random.hpp"

using pnpbs::TetrahedronCorners;
using P = pnpbs::Point<3>;

namespace {

// Four corners of a cube with side 2.
constexpr TetrahedronCorners kRegular{P{1, 1, 1}, P{-1, -1, 1}, P{1, -1, -1}, P{-1, 1, -1}};
// Two centres of neighbouring cells, and an edge of the square between them.
constexpr TetrahedronCorners kBodyCentred{P{0, 0, 0}, P{0, 0, 2}, P{1, 1, 1}, P{1, -1, 1}};

std::array<double, 6> sorted_angles(const TetrahedronCorners& x) {
  std::array<double, 6> angles = pnpbs::dihedral_angles(x);
  std::sort(angles.begin(), angles.end());
  return angles;
}

// Returns a rotated, scaled and shifted copy with the corners in random order.
TetrahedronCorners similar(TetrahedronCorners x, Random& random, double size) {
  const double phi = random.between(0, 6), psi = random.between(0, 6);
  const P shift{random.between(-9, 9), random.between(-9, 9), random.between(-9, 9)};
  for (P& corner : x) {
    const P turned{std::cos(phi) * corner[0] - std::sin(phi) * corner[1],
                   std::sin(phi) * corner[0] + std::cos(phi) * corner[1], corner[2]};
    corner = {size * (turned[0] + shift[0]),
              size * (std::cos(psi) * turned[1] - std::sin(psi) * turned[2] + shift[1]),
              size * (std::sin(psi) * turned[1] + std::cos(psi) * turned[2] + shift[2])};
  }
  random.shuffle(x);
  return x;
}

}  // namespace

START_TEST(regular_tetrahedron) {
  const double angle = std::acos(1.0 / 3) * 180 / std::acos(-1.0);
  Random random(1);
  for (const double size : {1.0, 1e-9, 1e7}) {
    const TetrahedronCorners x = similar(kRegular, random, size);
    ck_assert_double_eq_tol(std::fabs(pnpbs::tetrahedron_quality(x)), 1, 1e-13);
    for (const double a : pnpbs::dihedral_angles(x)) ck_assert_double_eq_tol(a, angle, 1e-11);
    const pnpbs::Circumsphere sphere = pnpbs::circumsphere(x);
    ck_assert_double_eq_tol(sphere.radius, std::sqrt(3.0) * size, 1e-13 * size);
    for (const P& corner : x)
      ck_assert_double_eq_tol(pnpbs::distance<3>(sphere.centre, corner), sphere.radius,
                              1e-13 * size);
  }
}
END_TEST

// r_in = sqrt(2) / 4 and R = sqrt(5) / 4 of the cell side, so 3 r_in / R = 3 / sqrt(10).
START_TEST(tetrahedron_of_the_body_centred_lattice) {
  Random random(2);
  for (const double size : {1.0, 1e-9, 1e7}) {
    const TetrahedronCorners x = similar(kBodyCentred, random, size);
    ck_assert_double_eq_tol(std::fabs(pnpbs::tetrahedron_quality(x)), 3 / std::sqrt(10.0), 1e-13);
    const std::array<double, 6> angles = sorted_angles(x);
    for (std::size_t k = 0; k < 6; ++k) ck_assert_double_eq_tol(angles[k], k < 4 ? 60 : 90, 1e-11);
    ck_assert_double_eq_tol(pnpbs::min_dihedral_angle(x), 60, 1e-11);
    ck_assert_double_eq_tol(pnpbs::circumsphere(x).radius, std::sqrt(5.0) / 2 * size, 1e-13 * size);
  }
}
END_TEST

// The angle at each edge of the corner of a cube, and at the opposite edges.
START_TEST(angles_by_edge) {
  const TetrahedronCorners corner{P{0, 0, 0}, P{1, 0, 0}, P{0, 1, 0}, P{0, 0, 2}};
  const std::array<double, 6> angles = pnpbs::dihedral_angles(corner);
  const double degree = std::acos(-1.0) / 180;
  const double expected[6] = {90,
                              90,
                              90,
                              std::acos(1.0 / 3) / degree,
                              std::acos(2.0 / 3) / degree,
                              std::acos(2.0 / 3) / degree};
  // The normal of the oblique face is (2, 2, 1) / 3, those of the others are the axes.
  for (std::size_t k = 0; k < 6; ++k) ck_assert_double_eq_tol(angles[k], expected[k], 1e-12);
}
END_TEST

START_TEST(turned_over) {
  ck_assert_double_gt(pnpbs::tetrahedron_quality({P{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), 0);
  ck_assert_double_lt(pnpbs::tetrahedron_quality({P{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}}), 0);
}
END_TEST

// Four nodes nearly or exactly on a circle: angles are near 0 at the sides and near 180 at the
// diagonals, and R stays accurate.
START_TEST(slivers) {
  for (const double lift : {1e-3, 1e-6, 1e-9}) {
    const TetrahedronCorners x{P{1, 0, lift}, P{0, 1, -lift}, P{-1, 0, lift}, P{0, -1, -lift}};
    const std::array<double, 6> angles = sorted_angles(x);
    // Half of each angle is the height over the distance from the side to the centre, sqrt(1 / 2).
    const double small = 2 * std::atan(lift * std::sqrt(2.0)) * 180 / std::acos(-1.0);
    for (std::size_t k = 0; k < 4; ++k) ck_assert_double_eq_tol(angles[k], small, 1e-6 * small);
    const double large = 180 - 2 * std::atan(2 * lift) * 180 / std::acos(-1.0);
    for (std::size_t k = 4; k < 6; ++k) ck_assert_double_eq_tol(angles[k], large, 1e-9);
    ck_assert_double_eq_tol(pnpbs::circumsphere(x).radius, std::sqrt(1 + lift * lift), 1e-6);
    const double quality = std::fabs(pnpbs::tetrahedron_quality(x));
    ck_assert_double_gt(quality, 0);
    ck_assert_double_lt(quality, 5 * lift);
  }
  const TetrahedronCorners flat{P{1, 0, 0}, P{0, 1, 0}, P{-1, 0, 0}, P{0, -1, 0}};
  quick_assert(pnpbs::circumsphere(flat).flat);
  ck_assert_double_eq(pnpbs::tetrahedron_quality(flat), 0);
  ck_assert_double_eq(pnpbs::min_dihedral_angle(flat), 0);
}
END_TEST

TEST_SUITE(test_tetrahedron_quality) {
  return run_suite("tetrahedron_quality",
                   {regular_tetrahedron, tetrahedron_of_the_body_centred_lattice, angles_by_edge,
                    turned_over, slivers});
}
