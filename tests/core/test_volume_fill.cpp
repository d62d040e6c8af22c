// SPDX-License-Identifier: BSD-3-Clause
// Initial inner nodes of a volume: A15 for constant d, the expected number for variable d, and the
// same nodes for any requested parts of the domain.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "comm/communicator.hpp"
#include "initial/graded_fill.hpp"
#include "initial/initial_fill.hpp"
#include "initial/volume/cubic_lattice.hpp"
#include "mapped_volume.hpp"
#include "random.hpp"
#include "run_kernel_suite.hpp"

using P = pnpbs::Point<3>;
using pnpbs::Box;

namespace {

constexpr double kA15Cell = 1.7395;  // side of a cell over d: the cube root of 8 / 1.52

// Returns a cube with one corner at the origin.
surfaces::Surface cube(double side) {
  return scaled(surfaces::cubes(1, [](auto, auto, auto) { return true; }), side / 6);
}

bool all(std::int32_t) { return true; }

template <class Wanted>
std::vector<P> fill(const Mapped& m, const VolumeSpacing& d, const Wanted& wanted) {
  std::vector<P> nodes = pnpbs::lattice_fill<3>(m.map, m.surface.bounds(), wanted);
  const auto values_at = [&](const std::vector<P>& centres) {
    std::vector<double> values;
    for (const P& x : centres) values.push_back(d(x));
    return values;
  };
  const pnpbs::GradedFill<3> whole(m.map, all), steep(m.map, wanted);
  std::vector<std::int64_t> before = whole.wanted_nodes(values_at(whole.centres()));
  std::exclusive_scan(before.begin(), before.end(), before.begin(), std::int64_t{0});
  for (const P& x : steep.place(values_at(steep.centres()), before)) nodes.push_back(x);
  return nodes;
}

bool in_box(const Box<3>& box, const P& x) {
  bool in = true;
  for (std::size_t k = 0; k < 3; ++k) in = in && x[k] >= box.low[k] && x[k] < box.high[k];
  return in;
}

double min_distance(const std::vector<P>& nodes) {
  double min = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      min = std::min(min, pnpbs::squared_distance<3>(nodes[i], nodes[j]));
  return std::sqrt(min);
}

// Returns how many nodes have each number of neighbours within this distance, away from the rim of
// the box.
std::vector<int> neighbour_counts(const std::vector<P>& nodes, const Box<3>& box, double within) {
  std::vector<int> counts(40, 0);
  Box<3> inner = box;
  for (std::size_t k = 0; k < 3; ++k) {
    inner.low[k] += within;
    inner.high[k] -= within;
  }
  for (const P& x : nodes) {
    if (!in_box(inner, x)) continue;
    std::size_t near = 0;
    for (const P& y : nodes) near += pnpbs::distance<3>(x, y) < within;
    ++counts[near - 1];
  }
  return counts;
}

std::vector<P> sites(const pnpbs::CubicLattice& lattice, const Box<3>& box) {
  std::vector<P> nodes;
  lattice.for_nodes(box, [&](const P& x) {
    if (in_box(box, x)) nodes.push_back(x);
  });
  return nodes;
}

Box<3> cube_box(double low, double side) {
  return {{low, low, low}, {low + side, low + side, low + side}};
}

}  // namespace

START_TEST(a15_over_the_whole_domain) {
  const double d = 0.1, cell = kA15Cell * d;
  // The layers are an integer number of half cells apart, so nothing is stretched.
  const Box<3> bounds = cube_box(3, 1.4 * d + 15 * 0.5 * cell);
  const pnpbs::CubicLattice lattice(d, bounds, true);
  const Box<3> cells = cube_box(3 + 0.9 * d, 5 * cell);
  const std::vector<P> nodes = sites(lattice, cells);
  ck_assert_uint_eq(nodes.size(), 8 * 125);
  ck_assert_double_eq_tol(static_cast<double>(nodes.size()) / std::pow(5 * cell / d, 3), 1.52,
                          1e-3);
  ck_assert_double_eq_tol(min_distance(nodes), 0.5 * cell, 1e-4 * d);
  const std::vector<int> counts = neighbour_counts(nodes, cells, 0.65 * cell);
  ck_assert_int_gt(counts[12], 20);
  ck_assert_int_gt(counts[14], 3 * counts[12] / 2);
  ck_assert_int_eq(counts[12] + counts[14], std::accumulate(counts.begin(), counts.end(), 0));
  // Three nodes of every cell lie in the first layer off each side of the box.
  for (std::size_t k = 0; k < 3; ++k)
    for (const double side : {bounds.low[k] + 0.7 * d, bounds.high[k] - 0.7 * d}) {
      Box<3> layer = cells;
      layer.low[k] = side - 1e-3 * d;
      layer.high[k] = side + 1e-3 * d;
      ck_assert_uint_eq(sites(lattice, layer).size(), 3 * 25);
    }
}
END_TEST

START_TEST(body_centred_in_patches) {
  const double d = 0.1, cell = pnpbs::Lattice<3>::kCell * d;
  const pnpbs::CubicLattice lattice(d, cube_box(-1, 1), false);
  const Box<3> cells = cube_box(-0.99, 8 * cell);
  const std::vector<P> nodes = sites(lattice, cells);
  ck_assert_uint_eq(nodes.size(), 2 * 512);
  ck_assert_double_eq_tol(static_cast<double>(nodes.size()) / std::pow(8 * cell / d, 3), 1.575,
                          1e-3);
  ck_assert_double_eq_tol(min_distance(nodes), std::sqrt(0.75) * cell, 1e-12);
  const std::vector<int> counts = neighbour_counts(nodes, cells, 1.2 * cell);
  ck_assert_int_gt(counts[14], 200);
  ck_assert_int_eq(counts[14], std::accumulate(counts.begin(), counts.end(), 0));
}
END_TEST

namespace {

double gap_to_sides(const P& x) {
  double gap = 1;
  for (const double along : x) gap = std::min({gap, along, 1 - along});
  return gap;
}

// Returns the expected number of nodes in the unit cube without a margin of `gap` times d.
double meant(double density, const VolumeSpacing& d, double gap) {
  constexpr int kFine = 150;
  Random random(1);
  double sum = 0;
  for (int cell = 0; cell < kFine * kFine * kFine; ++cell) {
    P x{cell % kFine + 0.0, cell / kFine % kFine + 0.0, cell / kFine / kFine + 0.0};
    for (double& along : x) along = (along + random.between(0, 1)) / kFine;
    const double value = d(x);
    if (gap_to_sides(x) >= gap * value) sum += density / (value * value * value);
  }
  return sum / (1.0 * kFine * kFine * kFine);
}

void expect_meant(double density, const VolumeSpacing& d, double gap, double tolerance) {
  const Mapped m(cube(1), d);
  const std::vector<P> nodes = fill(m, d, all);
  const double expected = meant(density, d, gap);
  ck_assert_double_gt(expected, 5000);
  ck_assert_double_eq_tol(static_cast<double>(nodes.size()), expected, tolerance * expected);
  // The leaf may have another d than the node.
  for (const P& x : nodes) quick_assert(gap_to_sides(x) > 0.45 * d(x));
}

}  // namespace

START_TEST(as_many_as_d_means) {
  // The nodes of a side represent the region within 0.38 d of it. Between 36 half cells nothing is
  // stretched.
  expect_meant(1.52, constant(1 / (1.4 + 36 * 0.5 * kA15Cell)), 0.38, 0.01);
  for (const P& finest : {P{0.3, 0.7, 0.4}, P{0.4, 0.63, 0.45}, P{0.6, 0.5, 0.55}}) {
    const auto way = [=](const P& x) { return pnpbs::distance<3>(x, finest); };
    // The lattices of patches end on average at 0.5 d from the high sides of the box.
    expect_meant(
        1.575, [=](const P& x) { return 0.018 + 0.012 * way(x); }, 0.44, 0.01);
    // The cells are filled one by one, which is less accurate at the sides.
    expect_meant(
        1.575, [=](const P& x) { return 0.007 + 0.16 * way(x); }, 0.5, 0.015);
  }
}
END_TEST

namespace {

// A domain with a hole and a cavity. Leaves outside the domain are not requested.
surfaces::Surface pierced() { return scaled(surfaces::pierced_cube(), 1.0 / 48); }

void expect_the_same_from_parts(const VolumeSpacing& d, std::size_t min_nodes) {
  const Mapped m(pierced(), d);
  std::vector<P> whole = fill(m, d, all), parts;
  ck_assert_uint_gt(whole.size(), min_nodes);
  for (std::int32_t part = 0; part < 3; ++part) {
    const auto wanted = [&](std::int32_t leaf) { return leaf * 7 % 5 % 3 == part; };
    for (const P& x : fill(m, d, wanted)) {
      quick_assert(wanted(m.map.tree().leaf_at(x)));
      parts.push_back(x);
    }
  }
  std::sort(whole.begin(), whole.end());
  std::sort(parts.begin(), parts.end());
  quick_assert(whole == parts);
  quick_assert(std::adjacent_find(whole.begin(), whole.end()) == whole.end());
}

}  // namespace

START_TEST(the_same_from_parts) {
  expect_the_same_from_parts(constant(0.05), 3000);
  expect_the_same_from_parts([](const P& x) { return 0.04 + 0.03 * x[0]; }, 3000);
  expect_the_same_from_parts([](const P& x) { return 0.02 + 0.2 * x[0]; }, 3000);
}
END_TEST

// A tree that is fine in one half only creates the nodes there, given information about the other
// half.
START_TEST(the_same_from_a_tree_of_which_a_part_is_fine) {
  const VolumeSpacing d = [](const P& x) { return 0.04 + 0.02 * x[1]; };
  const Mapped m(pierced(), d);
  const auto low = [](const P& x) { return x[2] < 0.5; };
  pnpbs::SizedTree<3> part;
  part.build_part(*pnpbs::serial_communicator(), m.surface.bounds(), m.mesh, evaluator_of(d),
                  1'000'000, [&](const pnpbs::BackgroundTree<3>& tree, std::int32_t c, double) {
                    return tree.cell(c).depth < 2 || low(tree.cell_centre(c));
                  });
  const std::vector<pnpbs::SpacingSummary<3>> known = pnpbs::spacing_summaries<3>(m.map, {});
  std::vector<pnpbs::LeafSummary<3>> unrefined;
  std::vector<char> fine;
  for (std::int32_t leaf = 0; leaf < part.tree().leaf_count(); ++leaf) {
    const std::int32_t c = part.tree().leaf_cell(leaf);
    const std::int32_t there =
        m.map.tree().cell_at(part.tree().cell_centre(c), part.tree().cell(c).depth);
    fine.push_back(low(part.tree().cell_centre(c)));
    if (!fine.back()) unrefined.push_back({leaf, known[static_cast<std::size_t>(there)]});
  }
  const auto wanted = [&](std::int32_t leaf) { return fine[static_cast<std::size_t>(leaf)] != 0; };
  const std::vector<P> own = pnpbs::lattice_fill<3>(part, m.surface.bounds(), wanted, unrefined);
  std::vector<P> expected = pnpbs::lattice_fill<3>(m.map, m.surface.bounds(), all);
  std::erase_if(expected, [&](const P& x) {
    return !fine[static_cast<std::size_t>(part.tree().leaf_at(x))];
  });
  ck_assert_uint_gt(expected.size(), 2000);
  quick_assert(own == expected);
}
END_TEST

START_TEST(clear_of_a_sphere) {
  const double unit = 0x1p-10;
  const VolumeSpacing d = [](const P& x) { return 0.1 + 0.02 * x[0]; };
  for (const VolumeSpacing& spacing : {constant(0.11), d}) {
    const Mapped m(scaled(surfaces::sphere(3, 900), unit), spacing);
    const std::vector<P> nodes = fill(m, spacing, all);
    ck_assert_uint_gt(nodes.size(), 2000);
    std::size_t nearly_too_near = 0;
    for (const P& x : nodes) {
      // The sphere is convex, so nodes are on one side of the plane of every facet, at this
      // distance from it.
      double gap = 1;
      for (std::size_t t = 0; t < m.count(); ++t) {
        const P a = m.surface.at(m.surface.corner(t, 0)), b = m.surface.at(m.surface.corner(t, 1)),
                c = m.surface.at(m.surface.corner(t, 2));
        P u, v, w;
        for (std::size_t k = 0; k < 3; ++k) {
          u[k] = b[k] - a[k];
          v[k] = c[k] - a[k];
          w[k] = a[k] - x[k];
        }
        const P n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
        gap =
            std::min(gap, (n[0] * w[0] + n[1] * w[1] + n[2] * w[2]) / std::hypot(n[0], n[1], n[2]));
      }
      quick_assert(gap > 0.5 * 0.97 * spacing(x));
      nearly_too_near += gap < 0.6 * spacing(x);
    }
    ck_assert_uint_gt(nearly_too_near, 50);
  }
}
END_TEST

START_TEST(no_room_for_any) {
  quick_assert(fill(Mapped(cube(0.09), constant(0.1)), constant(0.1), all).empty());
  quick_assert(fill(Mapped(cube(1), constant(50)), constant(50), all).empty());
}
END_TEST

TEST_SUITE(test_volume_fill) {
  return run_kernel_suite(
      "volume_fill",
      {a15_over_the_whole_domain, body_centred_in_patches, as_many_as_d_means, the_same_from_parts,
       the_same_from_a_tree_of_which_a_part_is_fine, clear_of_a_sphere, no_room_for_any});
}
