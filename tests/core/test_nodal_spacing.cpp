// SPDX-License-Identifier: BSD-3-Clause
// A spacing from nodal values: linear on triangles, extrapolated from the border, and independent
// of the distribution of the triangles. Results are compared with plain loops over all triangles.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "nodal_parts.hpp"
#include "random.hpp"
#include "run_kernel_suite.hpp"
#include "spacing/nodal_spacing.hpp"

using NodalPatch = pnpbs::NodalPatch<2>;
using Patch = pnpbs::Patch<2>;
using PatchAnswer = pnpbs::PatchAnswer<2>;
using P = pnpbs::Point<2>;

namespace {

// NodalSpacing is collective and therefore not a LocalSpacing.
using pnpbs::LocalSpacing;
static_assert(std::is_convertible_v<const pnpbs::GridSpacing<2>*, const LocalSpacing<2>*>);
static_assert(!std::is_convertible_v<const pnpbs::NodalSpacing<2>*, const LocalSpacing<2>*>);
static_assert(!std::is_convertible_v<pnpbs::SpacingEvaluator<2>, pnpbs::LocalSpacingEvaluator<2>>);

constexpr int kCells = 12;

// A square grid with randomly moved inner nodes, each cell cut in two, with shuffled ids and one
// cell in the middle missing.
Patch shaken_grid(Random& random, double (*value)(double, double)) {
  Patch patch;
  std::vector<std::int64_t> ids((kCells + 1) * (kCells + 1));
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = 100 + static_cast<std::int64_t>(i);
  random.shuffle(ids);
  for (int row = 0; row <= kCells; ++row)
    for (int column = 0; column <= kCells; ++column) {
      const bool inner = row > 0 && row < kCells && column > 0 && column < kCells;
      const double shake = inner ? 0.3 : 0;
      const P x{(column + random.between(-shake, shake)) / kCells,
                (row + random.between(-shake, shake)) / kCells};
      patch.nodes.push_back({x, ids[patch.nodes.size()], value(x[0], x[1])});
    }
  const auto by_id = [&](auto row) {
    std::sort(row.begin(), row.end(), [&](std::int32_t a, std::int32_t b) {
      return patch.nodes[static_cast<std::size_t>(a)].id <
             patch.nodes[static_cast<std::size_t>(b)].id;
    });
    return row;
  };
  const auto is_cell = [](int row, int column) {
    const bool hole = row == kCells / 2 && column == kCells / 2;
    return row >= 0 && row < kCells && column >= 0 && column < kCells && !hole;
  };
  for (std::int32_t row = 0; row <= kCells; ++row)
    for (std::int32_t column = 0; column <= kCells; ++column) {
      const std::int32_t a = row * (kCells + 1) + column, right = a + 1, up = a + kCells + 1;
      if (is_cell(row, column)) {
        patch.simplices.push_back(by_id(std::array{a, right, up + 1}));
        patch.simplices.push_back(by_id(std::array{a, up + 1, up}));
      }
      if (column < kCells && is_cell(row, column) != is_cell(row - 1, column))
        patch.border.push_back(by_id(std::array{a, right}));
      if (row < kCells && is_cell(row, column) != is_cell(row, column - 1))
        patch.border.push_back(by_id(std::array{a, up}));
    }
  return patch;
}

double plane(double x, double y) { return 1 + 0.5 * x + 0.25 * y; }
double waves(double x, double y) { return 2 + std::sin(9 * x) * std::cos(7 * y); }

bool in_hole(const Patch& patch, const P& x) {
  const auto side = [&](std::int32_t i, std::int32_t j) {
    const P &a = patch.nodes[static_cast<std::size_t>(i)].x,
            &b = patch.nodes[static_cast<std::size_t>(j)].x;
    return (b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0]);
  };
  const std::int32_t a = (kCells / 2) * (kCells + 1) + kCells / 2, up = a + kCells + 1;
  return side(a, a + 1) > 0 && side(a + 1, up + 1) > 0 && side(up + 1, up) > 0 && side(up, a) > 0;
}

bool in_domain(const Patch& patch, const P& x) {
  return x[0] > 0 && x[0] < 1 && x[1] > 0 && x[1] < 1 && !in_hole(patch, x);
}

// Returns the value at the nearest point of the border, by a search over all of it.
double nearest_value(const Patch& patch, const P& x) {
  double min = std::numeric_limits<double>::infinity(), value = 0;
  for (const auto& edge : patch.border) {
    const auto &a = patch.nodes[static_cast<std::size_t>(edge[0])],
               &b = patch.nodes[static_cast<std::size_t>(edge[1])];
    for (int k = 0; k <= 2000; ++k) {
      const double t = k / 2000.0;
      const double gap =
          std::hypot(a.x[0] + t * (b.x[0] - a.x[0]) - x[0], a.x[1] + t * (b.x[1] - a.x[1]) - x[1]);
      if (gap >= min) continue;
      min = gap;
      value = a.value + t * (b.value - a.value);
    }
  }
  return value;
}

}  // namespace

START_TEST(linear_functions_are_exact) {
  Random random(1);
  const Patch patch = shaken_grid(random, plane);
  const pnpbs::NodalSpacing<2> spacing(pnpbs::serial_communicator(), patch);
  std::vector<P> points;
  while (points.size() < 20000) {
    const P x = random.point<2>({{0, 0}, {1, 1}});
    if (in_domain(patch, x)) points.push_back(x);
  }
  std::vector<double> d(points.size());
  spacing.evaluate(static_cast<std::int64_t>(points.size()), points.data(), d.data());
  for (std::size_t i = 0; i < points.size(); ++i)
    quick_assert(std::fabs(d[i] - plane(points[i][0], points[i][1])) < 1e-13);
  spacing.evaluate(0, nullptr, nullptr);
}
END_TEST

// Compares with barycentric interpolation in the triangle that a plain loop finds.
START_TEST(interpolates_in_the_right_triangle) {
  Random random(2);
  const Patch patch = shaken_grid(random, waves);
  const NodalPatch one(patch);
  for (int n = 0; n < 3000; ++n) {
    const P x = random.point<2>({{0, 0}, {1, 1}});
    if (!in_domain(patch, x)) continue;
    PatchAnswer answer;
    one.interpolate(x, answer);
    quick_assert(answer.found());
    int found = 0;
    for (const auto& corners : patch.simplices) {
      long double weight[3], all = 0;
      for (int k = 0; k < 3; ++k) {
        const P &a = patch.nodes[static_cast<std::size_t>(corners[(k + 1) % 3])].x,
                &b = patch.nodes[static_cast<std::size_t>(corners[(k + 2) % 3])].x;
        weight[k] = (a[0] - static_cast<long double>(x[0])) * (b[1] - x[1]) -
                    (a[1] - static_cast<long double>(x[1])) * (b[0] - x[0]);
        all += weight[k];
      }
      long double value = 0;
      bool inside = true;
      for (int k = 0; k < 3; ++k) {
        inside = inside && weight[k] / all >= 0;
        value += weight[k] / all * patch.nodes[static_cast<std::size_t>(corners[k])].value;
      }
      if (!inside) continue;
      ++found;
      quick_assert(std::fabs(answer.value - static_cast<double>(value)) < 1e-13);
    }
    quick_assert(found == 1);
  }
}
END_TEST

START_TEST(extends_from_the_nearest_point_of_the_border) {
  Random random(3);
  const Patch patch = shaken_grid(random, waves);
  const NodalPatch one(patch);
  int holes = 0;
  for (int n = 0; n < 400; ++n) {
    const P x = n % 2 == 0 ? random.point<2>({{-0.5, -0.5}, {1.5, 1.5}})
                           : random.point<2>({{0.48, 0.48}, {0.6, 0.6}});
    if (in_domain(patch, x)) continue;
    holes += in_hole(patch, x);
    PatchAnswer answer;
    one.interpolate(x, answer);
    quick_assert(!answer.found());
    one.extend(x, answer);
    quick_assert(std::fabs(answer.value - nearest_value(patch, x)) < 2e-3);
  }
  ck_assert_int_gt(holes, 10);
}
END_TEST

// Results are equal to the bit on edges, at nodes, inside and outside.
START_TEST(the_same_however_distributed) {
  Random random(4);
  const Patch patch = shaken_grid(random, waves);
  std::vector<P> points;
  for (const pnpbs::PatchNode<2>& node : patch.nodes) points.push_back(node.x);
  for (int k = 0; k <= 8 * kCells; ++k) points.push_back({k / (8.0 * kCells), 0});
  for (int n = 0; n < 2000; ++n) points.push_back(random.point<2>({{-0.1, -0.1}, {1.1, 1.1}}));
  expect_the_same_however_distributed<2>(patch, points, random);
}
END_TEST

// The value at a node is the given one, independent of the triangle used.
START_TEST(nodes_have_their_values) {
  Random random(5);
  const Patch patch = shaken_grid(random, waves);
  const NodalPatch one(patch);
  for (const pnpbs::PatchNode<2>& node : patch.nodes) {
    PatchAnswer answer;
    one.interpolate(node.x, answer);
    quick_assert(std::fabs(answer.value - node.value) < 2e-15);
  }
}
END_TEST

TEST_SUITE(test_nodal_spacing) {
  return run_kernel_suite(
      "nodal_spacing", {linear_functions_are_exact, interpolates_in_the_right_triangle,
                        extends_from_the_nearest_point_of_the_border, the_same_however_distributed,
                        nodes_have_their_values});
}
