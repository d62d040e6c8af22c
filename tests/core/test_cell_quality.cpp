// SPDX-License-Identifier: BSD-3-Clause
// Voronoi cells of lattices with known measures, also with one node displaced.
#include <cmath>

#include "distorted_nodes.hpp"
#include "quality/plane/cell_quality.hpp"
#include "run_kernel_suite.hpp"

using Level = pnpbs::Level<2>;
using P = pnpbs::Point<2>;

namespace {

constexpr double kD = 0.05;

const Build kSquare = [](pnpbs::PlaneDomain& p) {
  shapes::add_loop(p, shapes::rectangle(0, 0, 1, 1));
};

// Rows of nodes at distances kD, shifted by half of that from row to row. Only nodes well inside
// the domain move; cells of other nodes do not count.
LevelRun lattice(double row_height) {
  LevelRun run(kSquare, constant(kD));
  pnpbs::IncomingNodes<2> nodes;
  for (int row = 1; row * row_height < 0.97; ++row)
    for (int column = 1; column < 19; ++column)
      nodes.push_back({{kD * (column + 0.5 * (row % 2)), row * row_height}, std::ssize(nodes)});
  pnpbs::take(*run.level, nodes, 0);
  run.renew_stars();
  Level& level = *run.level;
  for (std::int64_t i = 0; i < level.nodes.count; ++i)
    if (level.nodes.moves(i) && level.map().clearance(level.nodes.position(i), 1) < 3 * kD)
      level.nodes.carrier(i) = pnpbs::Carrier::fixed;
  return run;
}

pnpbs::CellQuality measured(const Level& level) {
  return pnpbs::measure_cells(*level.comm, {level.nodes}, level.stars, {kD, kD},
                              [](const pnpbs::View<double>&) {});
}

void expect(const pnpbs::CellFigure& figure, std::int64_t number, double mean, double worst) {
  ck_assert_int_eq(figure.number, number);
  ck_assert_double_eq_tol(figure.mean, mean, 1e-9);
  ck_assert_double_eq_tol(figure.worst, worst, 1e-12);
}

std::int64_t cells_of(const Level& level) {
  std::int64_t cells = 0;
  for (std::int64_t i = 0; i < level.nodes.count; ++i) cells += level.nodes.moves(i);
  return cells;
}

std::int64_t edges_between_cells(const Level& level) {
  std::int64_t twice = 0;
  for (std::int64_t i = 0; i < level.nodes.count; ++i)
    if (level.nodes.moves(i))
      level.stars.for_neighbours(i, [&](std::int64_t j) { twice += level.nodes.moves(j); });
  return twice / 2;
}

}  // namespace

START_TEST(regular_hexagons) {
  const LevelRun run = lattice(kD * std::sqrt(0.75));
  const pnpbs::CellShape shape = measured(*run.level).shape;
  const std::int64_t cells = cells_of(*run.level), edges = edges_between_cells(*run.level);
  ck_assert_int_gt(cells, 150);
  ck_assert_int_gt(edges, 400);
  expect(shape.edge_ratio, cells, 1, 1);
  expect(shape.area_ratio, edges, 1, 1);
  expect(shape.dual_offset, edges, 0, 0);
}
END_TEST

// The circumcentre of a triangle with base a and height h lies (h^2 - a^2 / 4) / (2 h) above the
// base. All edges have a centre of symmetry.
START_TEST(flat_hexagons) {
  const double h = 0.8 * kD, above = (h * h - kD * kD / 4) / (2 * h);
  const double across_base = 2 * above, across_side = std::hypot(kD / 2, h - 2 * above);
  const LevelRun run = lattice(h);
  const pnpbs::CellQuality cells = measured(*run.level);
  const std::int64_t edges = edges_between_cells(*run.level);
  const double ratio = across_base / across_side;
  ck_assert_double_lt(ratio, 0.83);
  expect(cells.shape.edge_ratio, cells_of(*run.level), ratio, ratio);
  expect(cells.shape.area_ratio, edges, 1, 1);
  expect(cells.shape.dual_offset, edges, 0, 0);
  ck_assert_int_eq(std::ssize(cells.bands), 1);
  expect(cells.bands[0].shape.edge_ratio, cells_of(*run.level), ratio, ratio);
}
END_TEST

// Values to first order in t, the displacement of one node along its row over d. The cells of this
// node, of its two neighbours in the row and of its four other neighbours have edge ratios of 1 - 2
// t and 1 - 1.5 t. The areas of the two neighbours in the row change by t / 3, and the midpoints of
// eight Voronoi edges shift by t / sqrt(12). Voronoi cells computed by Qhull for 323 nodes with t =
// 1e-4 agree.
START_TEST(one_node_off) {
  constexpr double kWay = 1e-5;
  LevelRun run = lattice(kD * std::sqrt(0.75));
  Level& level = *run.level;
  std::int64_t middle = -1;
  for (std::int64_t i = 0; i < level.nodes.count; ++i)
    if (pnpbs::distance<2>(level.nodes.position(i), {0.5, 0.5}) < 0.6 * kD) middle = i;
  const P place = level.nodes.position(middle);
  level.nodes.set_position(middle, {place[0] + kWay * kD, place[1]});
  const pnpbs::CellShape shape = measured(level).shape;
  const auto expect_ways = [](const pnpbs::CellFigure& figure, double regular, double worst,
                              double all) {
    ck_assert_double_eq_tol(std::fabs(figure.worst - regular) / kWay, worst, 1e-3);
    const double sum = std::fabs(figure.mean - regular) * static_cast<double>(figure.number);
    ck_assert_double_eq_tol(sum / kWay, all, 0.02);
  };
  expect_ways(shape.edge_ratio, 1, 2, 12);
  expect_ways(shape.area_ratio, 1, 1.0 / 3, 20.0 / 3);
  expect_ways(shape.dual_offset, 0, 1 / std::sqrt(12), 8 / std::sqrt(12));
}
END_TEST

TEST_SUITE(test_cell_quality) {
  return run_kernel_suite("cell_quality", {regular_hexagons, flat_hexagons, one_node_off});
}
