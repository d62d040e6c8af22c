// SPDX-License-Identifier: BSD-3-Clause
// Voronoi cells within a body, with known volumes: bounded by the wall, by bisectors and by the
// reach, but not by bisectors with points behind a wall.
#include <cmath>
#include <numbers>
#include <vector>

#include "particles/cell_in_body.hpp"
#include "run_kernel_suite.hpp"

using pnpbs::CellInBody;
using pnpbs::CurveRole;
using pnpbs::PlaneDomain;
using pnpbs::Point;
using pnpbs::SignedDistance;
using pnpbs::VolumeDomain;

namespace {

void add_rectangle(PlaneDomain& domain, double x0, double y0, double x1, double y1) {
  const double xy[] = {x0, y0, x1, y0, x1, y1, x0, y1};
  const std::int32_t tags[] = {1, 1, 1, 1};
  domain.add_polyline(CurveRole::boundary, true, 4, xy, tags, 30);
}

START_TEST(in_the_plane) {
  PlaneDomain domain;
  add_rectangle(domain, 0, 0, 1, 1);
  add_rectangle(domain, 1.02, 0, 2, 1);  // across a narrow gap
  domain.check();
  const SignedDistance<2> body(domain);
  const CellInBody<2> cell(body);
  const Point<2> x{0.7, 0.5};
  const auto expect = [&](double area, double reach, const std::vector<Point<2>>& neighbours) {
    ck_assert_double_eq_tol(cell.volume(x, reach, neighbours), area, 2e-4 * area);
  };
  expect(1, 2, {});
  expect(0.2, 2, {{0.7, 0.1}, {0.7, 0.9}, {0.3, 0.5}, {0.7, 0.95}});  // 0.5 wide, 0.4 high
  expect(1, 2, {{1.05, 0.5}});
  expect(0.5, 2, {{0.3, 0.5}, {1.05, 0.5}});
  expect(0.04 * std::numbers::pi, 0.2, {});
}
END_TEST

START_TEST(in_space) {
  VolumeDomain domain;
  domain.add_box(Point<3>{0, 0, 0}, Point<3>{1, 1, 1}, 1);
  domain.add_box(Point<3>{1.02, 0, 0}, Point<3>{2, 1, 1}, 2);
  domain.check();
  const SignedDistance<3> body(domain);
  const CellInBody<3> cell(body);
  const Point<3> x{0.7, 0.5, 0.5};
  const auto expect = [&](double volume, double reach, const std::vector<Point<3>>& neighbours) {
    ck_assert_double_eq_tol(cell.volume(x, reach, neighbours), volume, 5e-3 * volume);
  };
  expect(1, 2, {});
  expect(0.5, 2, {{0.3, 0.5, 0.5}});
  expect(0.5, 2, {{0.3, 0.5, 0.5}, {1.05, 0.5, 0.5}});
  expect(4 * std::numbers::pi / 3 * 0.008, 0.2, {});
}
END_TEST

}  // namespace

TEST_SUITE(test_cell_in_body) { return run_kernel_suite("cell_in_body", {in_the_plane, in_space}); }
