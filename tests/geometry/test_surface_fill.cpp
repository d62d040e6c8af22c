// SPDX-License-Identifier: BSD-3-Clause
// Initial nodes on surfaces: their number against integrals of d, positions on facets and off the
// features, and a hexagonal lattice on flat patches.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/quick_assert.hpp"
#include "expect_error.hpp"
#include "geometry/volume/triangles.hpp"
#include "initial/volume/surface_fill.hpp"
#include "run_suite.hpp"
#include "surface_case.hpp"

using pnpbs::SurfacePoint;
using space_shapes::P;
using space_shapes::SurfaceCase;
using Spacing = std::function<double(const P&)>;

namespace {

constexpr std::int64_t kMaxNodes = 1'000'000;

std::vector<SurfacePoint> fill(const SurfaceCase& c, const Spacing& d,
                               const pnpbs::NodeLimit& limit = kMaxNodes) {
  static const auto comm = pnpbs::serial_communicator();
  pnpbs::BackgroundTree<3> one_cell;
  one_cell.build(c.bounds(), [](const auto&, std::int32_t, std::int32_t, std::vector<char>&) {});
  return surface_fill(*comm, c.surface, space_shapes::evaluator_of(d), limit,
                      {one_cell, [](std::int32_t) { return true; }});
}

// Returns the integral of 2 / sqrt(3) / d^2 over all facets, with many points of each.
double wanted_nodes(const SurfaceCase& c, const Spacing& d) {
  constexpr int kParts = 12;
  double sum = 0;
  for (std::int32_t f = 0; f < c.facet_count(); ++f) {
    const auto [a, b, e] = c.surface.corners(f);
    const P normal = pnpbs::cross(pnpbs::difference(b, a), pnpbs::difference(e, a));
    const double part = 0.5 * pnpbs::length(normal) / (kParts * kParts);
    for (int i = 0; i < kParts; ++i)
      for (int j = 0; j < 2 * (kParts - i) - 1; ++j) {
        const double third = j % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
        const P x = c.point(f, (i + third) / kParts, (j / 2 + third) / kParts);
        sum += 2 / std::sqrt(3.0) * part / (d(x) * d(x));
      }
  }
  return sum;
}

void check_places(const SurfaceCase& c, const std::vector<SurfacePoint>& nodes, const Spacing& d) {
  for (const SurfacePoint& at : nodes) {
    const P x = pnpbs::nearest_on(c.surface.corners(at.facet), at.position);
    quick_assert(pnpbs::distance<3>(x, at.position) < 1e-14);
    quick_assert(c.surface.feature_clearance(at, 1) > 0.49 * d(at.position));
  }
}

// Returns the distance of each node to the nearest other node of its patch.
std::vector<double> nearest(const SurfaceCase& c, const std::vector<SurfacePoint>& nodes) {
  std::vector<double> gaps(nodes.size(), 1e9);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t j = 0; j < nodes.size(); ++j)
      if (i != j && c.surface.patch(nodes[i].facet) == c.surface.patch(nodes[j].facet))
        gaps[i] = std::min(gaps[i], pnpbs::distance<3>(nodes[i].position, nodes[j].position));
  return gaps;
}

START_TEST(test_density_on_a_ball) {
  const SurfaceCase fine(space_shapes::ball(5).mesh()), coarse(space_shapes::ball(2).mesh());
  for (const SurfaceCase* c : {&fine, &coarse})
    for (const Spacing& d : {Spacing([](const P&) { return 0.05; }),
                             Spacing([](const P& x) { return 0.04 + 0.02 * (1 + x[2]); })}) {
      const std::vector<SurfacePoint> nodes = fill(*c, d);
      check_places(*c, nodes, d);
      const double wanted = wanted_nodes(*c, d);
      ck_assert_double_eq_tol(static_cast<double>(nodes.size()) / wanted, 1, 0.005);
      // The number must match in every part as well.
      for (std::size_t k = 0; k < 3; ++k) {
        const auto above = std::count_if(
            nodes.begin(), nodes.end(), [k](const SurfacePoint& at) { return at.position[k] > 0; });
        const double half = wanted_nodes(*c, [&](const P& x) { return x[k] > 0 ? d(x) : 1e6; });
        ck_assert_double_eq_tol(static_cast<double>(above) / half, 1, 0.03);
      }
      for (const double gap : nearest(*c, nodes)) quick_assert(gap > 0.25 * 0.04);
    }
}
END_TEST

// Holds for any large d.
START_TEST(test_closed_patch_has_nodes) {
  const SurfaceCase c(space_shapes::ball(3).mesh());
  ck_assert_uint_eq(fill(c, [](const P&) { return 9; }).size(), 4);
}
END_TEST

START_TEST(test_lattice_on_a_cube) {
  constexpr double kSpacing = 0.0203;
  const Spacing d = [](const P&) { return kSpacing; };
  const SurfaceCase c(space_shapes::turned(space_shapes::cube(2), 0.3).mesh());
  const std::vector<SurfacePoint> nodes = fill(c, d);
  check_places(c, nodes, d);
  // A strip of d/2 along the edges, which have nodes of their own, stays free.
  const double side = 1 - kSpacing,
               wanted = 6 * 2 / std::sqrt(3.0) * side * side / (kSpacing * kSpacing);
  ck_assert_double_eq_tol(static_cast<double>(nodes.size()) / wanted, 1, 0.02);
  // Steps and rows are fitted to the edges: 49 and 57 of them.
  const double step = 1.0 / 49, slant = std::hypot(0.5 / 49, 1.0 / 57);
  std::vector<double> gaps = nearest(c, nodes);
  for (const double gap : gaps) quick_assert(std::fabs(gap - std::min(step, slant)) < 1e-12);
}
END_TEST

// Rows follow the longest edge for any facets.
START_TEST(test_lattice_follows_the_longest_edge) {
  const Spacing d = [](const P&) { return 0.1; };
  const SurfaceCase c(space_shapes::sheet(7, 3, 0.9, 3).mesh());
  const std::vector<SurfacePoint> nodes = fill(c, d);
  check_places(c, nodes, d);
  for (const SurfacePoint& at : nodes) {
    const double row = at.position[0] / 0.09;  // 0.9 / round(0.9 / 0.0866)
    quick_assert(std::fabs(row - std::round(row)) < 1e-9);
    quick_assert(row > 0.5 && row < 9.5);
  }
  ck_assert_uint_ge(nodes.size(), 9 * 29);
  ck_assert_uint_le(nodes.size(), 9 * 30);
}
END_TEST

// A flat patch with variable d, and a body with flat and curved patches.
START_TEST(test_mixed_patches) {
  const Spacing graded = [](const P& x) { return 0.01 + 0.02 * x[0]; };
  const SurfaceCase sheet(space_shapes::sheet(40, 40, 1, 1).mesh());
  const std::vector<SurfacePoint> varying = fill(sheet, graded);
  check_places(sheet, varying, graded);
  // The strips of d/2 along the border are subtracted.
  const double strips = wanted_nodes(sheet, [&](const P& x) {
    const double off = std::min({x[0], x[1], 1 - x[0], 1 - x[1]});
    return off < 0.5 * graded(x) ? graded(x) : 1e6;
  });
  ck_assert_double_eq_tol(
      static_cast<double>(varying.size()) / (wanted_nodes(sheet, graded) - strips), 1, 0.02);

  const Spacing d = [](const P&) { return 0.06; };
  const SurfaceCase body(space_shapes::cylinder(48, 8, 2).mesh());
  const std::vector<SurfacePoint> nodes = fill(body, d);
  check_places(body, nodes, d);
  // A piece at the rim counts fully or not at all, which amounts to half a strip at most.
  const double rims = 4 * space_shapes::pi * 0.06 * 2 / std::sqrt(3.0) / (0.06 * 0.06);
  ck_assert_double_eq_tol(static_cast<double>(nodes.size()) / (wanted_nodes(body, d) - rims), 1,
                          0.03);
}
END_TEST

START_TEST(test_repeats_to_the_bit) {
  const Spacing d = [](const P& x) { return 0.05 + 0.02 * x[1]; };
  const SurfaceCase c(space_shapes::ball(3).mesh());
  const std::vector<SurfacePoint> one = fill(c, d), two = fill(c, d);
  quick_assert(std::equal(one.begin(), one.end(), two.begin(), two.end(),
                          [](const SurfacePoint& a, const SurfacePoint& b) {
                            return a.facet == b.facet && a.position == b.position;
                          }));
}
END_TEST

START_TEST(test_one_facet) {
  space_shapes::Shape one;
  one.nodes = {{0, 0, 0}, {2, 0, 0.5}, {0.3, 1, 1}};
  one.triangles = {{0, 1, 2}};
  const SurfaceCase c(one.mesh());
  const Spacing d = [](const P&) { return 0.1; };
  const std::vector<SurfacePoint> nodes = fill(c, d);
  check_places(c, nodes, d);
  ck_assert_uint_gt(nodes.size(), 60);
  ck_assert_double_lt(static_cast<double>(nodes.size()), wanted_nodes(c, d));
  ck_assert_uint_eq(fill(c, [](const P&) { return 3; }).size(), 0);
  ck_assert_uint_eq(fill(SurfaceCase(space_shapes::Mesh()), d).size(), 0);
}
END_TEST

START_TEST(test_too_many) {
  const SurfaceCase c(space_shapes::ball(1).mesh());
  expect_error(pnpbs::ErrorKind::spacing, {"d = 1e-04", "max_nodes allows 1000000"},
               [&] { fill(c, [](const P&) { return 1e-4; }); });
}
END_TEST

// A needle is cut into far more pieces than it has nodes.
START_TEST(test_needle_takes_memory) {
  space_shapes::Shape needle;
  needle.nodes = {{0, 0, 0}, {100, 0, 0}, {0, 1e-3, 0}};
  needle.triangles = {{0, 1, 2}};
  const SurfaceCase c(needle.mesh());
  const Spacing d = [](const P&) { return 0.1; };
  ck_assert_uint_lt(fill(c, d).size(), 100);
  expect_error(pnpbs::ErrorKind::memory, {"pieces of the surface", "of memory, and"}, [&] {
    fill(c, d, {kMaxNodes, 1e6});
  });
}
END_TEST

}  // namespace

TEST_SUITE(test_surface_fill) {
  return run_suite("surface_fill", {test_density_on_a_ball, test_closed_patch_has_nodes,
                                    test_lattice_on_a_cube, test_lattice_follows_the_longest_edge,
                                    test_mixed_patches, test_repeats_to_the_bit, test_one_facet,
                                    test_too_many, test_needle_takes_memory});
}
