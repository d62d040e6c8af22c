// SPDX-License-Identifier: BSD-3-Clause
// Spacing functions: grids, errors, and the growth limit against a search over all sources.
#include <cmath>
#include <limits>
#include <vector>

#include "base/error.hpp"
#include "geometry/expect_error.hpp"
#include "level_run.hpp"
#include "limited_spacing.hpp"
#include "line_of_sight.hpp"
#include "random.hpp"
#include "run_kernel_suite.hpp"
#include "spacing/steepest_growth.hpp"

using pnpbs::GridSpacing;
using pnpbs::PlaneDomain;
using shapes::add_chain;
using shapes::add_loop;
using shapes::rectangle;
using P = pnpbs::Point<2>;
using P3 = pnpbs::Point<3>;

namespace {

template <int Dim>
double value_at(const pnpbs::Spacing<Dim>& spacing, const pnpbs::Point<Dim>& x) {
  double d = -1;
  spacing.evaluate(1, &x, &d);
  return d;
}

// ------------------------------------------------------------------ growth limit ---------------

constexpr double kGrowth = 0.15;

struct Limited {
  PlaneDomain domain;
  Plane raw;
  pnpbs::SizingField<2> spacing;

  Limited(const Build& build, Plane d, double growth = kGrowth) : raw(std::move(d)) {
    build(domain);
    domain.check();
    spacing =
        limited_spacing<2>(pnpbs::serial_communicator(), line_of_sight(domain, *spacing_of(raw)),
                           spacing_of(raw), growth, 1'000'000'000);
  }
  double at(const P& x) const { return value_at<2>(spacing, x); }
  double raw_at(const P& x) const { return raw(x[0], x[1]); }
};

void add_square(PlaneDomain& domain) { add_loop(domain, rectangle(0, 0, 1, 1)); }

// A region of fine bubbles, from which d rises steeply to a plateau.
struct Pit {
  P middle;
  double min, slope, max;

  double operator()(double x, double y) const {
    return std::min(max, min + slope * std::hypot(x - middle[0], y - middle[1]));
  }
  // Returns the limited d in a convex domain, for a growth limit below the slope.
  double limited(const P& x, double growth) const {
    return std::min(max, min + growth * pnpbs::distance<2>(x, middle));
  }
};

}  // namespace

// ------------------------------------------------------------------ grids ----------------------

START_TEST(grids_are_linear_in_each_direction) {
  const auto plane = [](double x, double y) { return 3 + 0.5 * x - 0.25 * y + 0.75 * x * y; };
  std::vector<double> values;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 5; ++i) values.push_back(plane(-1 + 0.5 * i, 2 + 0.25 * j));
  const GridSpacing<2> grid({5, 4}, {-1, 2}, {0.5, 0.25}, values);
  Random random(91);
  for (int trial = 0; trial < 1000; ++trial) {
    const P x{random.between(-1, 1), random.between(2, 2.75)};
    ck_assert_double_eq_tol(value_at<2>(grid, x), plane(x[0], x[1]), 1e-14);
    const P beyond{random.between(-9, 9), random.between(-9, 9)};
    ck_assert_double_eq_tol(
        value_at<2>(grid, beyond),
        plane(std::clamp(beyond[0], -1.0, 1.0), std::clamp(beyond[1], 2.0, 2.75)), 1e-13);
  }
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 5; ++i)
      quick_assert(value_at<2>(grid, {-1 + 0.5 * i, 2 + 0.25 * j}) ==
                   values[static_cast<std::size_t>(5 * j + i)]);
}
END_TEST

START_TEST(grids_are_linear_only_between_neighbours) {
  // Kinks at every grid line: only the four values around a point count.
  const GridSpacing<2> grid({3, 2}, {0, 0}, {1, 1}, {1, 2, 10, 3, 5, 20});
  ck_assert_double_eq(value_at<2>(grid, {0.5, 0}), 1.5);
  ck_assert_double_eq(value_at<2>(grid, {1.5, 0}), 6);
  ck_assert_double_eq(value_at<2>(grid, {0, 0.25}), 1.5);
  ck_assert_double_eq(value_at<2>(grid, {1.25, 0.5}), 0.5 * (4 + 8.75));
  ck_assert_double_eq(value_at<2>(grid, {2, 1}), 20);
  ck_assert_double_eq(value_at<2>(grid, {3, -7}), 10);
}
END_TEST

// A grid in space with noise of 1 % and a few low points, which samples of d may miss. The hints
// must contain these points and their slopes, compared with all neighbours of each.
START_TEST(grids_know_their_low_points) {
  constexpr int kSize = 6;
  const P3 origin{1, 2, 3}, step{0.5, 1, 2};
  Random random(93);
  std::vector<double> values;
  for (int i = 0; i < kSize * kSize * kSize; ++i) values.push_back(random.between(1, 1.01));
  for (const std::size_t low : {0, 50, 100, 215}) values[low] = 0.01;
  const GridSpacing<3> grid({kSize, kSize, kSize}, origin, step, values);
  const pnpbs::SpacingHints<3> known = grid.spacing_hints();
  ck_assert_uint_eq(known.values.size(), 4);
  for (const auto& value : known.values) {
    ck_assert_double_eq(value.d, 0.01);
    ck_assert_double_eq(value_at<3>(grid, value.x), 0.01);
  }
  std::size_t neighbours = 0;
  for (const int low : {0, 50, 100, 215})
    for (int k = 0, index = low; k < 3; ++k, index /= kSize)
      neighbours += (index % kSize > 0) + (index % kSize + 1 < kSize);
  ck_assert_uint_eq(known.slopes.size(), neighbours);
  for (const auto& slope : known.slopes) {
    ck_assert_double_eq(slope.d, 0.01);
    ck_assert_double_ge(slope.growth, 0.99 / 2);
    ck_assert_double_le(slope.growth, 1.01 / 0.5);
  }
}
END_TEST

START_TEST(grids_in_space_and_thin_ones) {
  const auto solid = [](double x, double y, double z) {
    return 1 + x + 2 * y + 3 * z + x * y - y * z + 0.5 * x * y * z;
  };
  std::vector<double> values;
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 4; ++i) values.push_back(solid(i, 0.5 * j, 2.0 * k));
  const GridSpacing<3> grid({4, 2, 3}, {0, 0, 0}, {1, 0.5, 2}, values);
  Random random(92);
  for (int trial = 0; trial < 1000; ++trial) {
    const P3 x{random.between(-1, 4), random.between(-1, 1), random.between(-1, 5)};
    ck_assert_double_eq_tol(
        value_at<3>(grid, x),
        solid(std::clamp(x[0], 0.0, 3.0), std::clamp(x[1], 0.0, 0.5), std::clamp(x[2], 0.0, 4.0)),
        1e-13);
  }
  const GridSpacing<2> row({3, 1}, {0, 0}, {1, 1}, {1, 2, 4});
  ck_assert_double_eq(value_at<2>(row, {1.5, 0.3}), 3);
  const GridSpacing<2> one({1, 1}, {0, 0}, {1, 1}, {7});
  ck_assert_double_eq(value_at<2>(one, {1.5, -0.3}), 7);
}
END_TEST

START_TEST(values_beside_a_hole_in_the_grid) {
  // NaN marks unknown values. It affects only points that need it.
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const GridSpacing<2> grid({3, 2}, {0, 0}, {1, 1}, {1, 2, nan, 1, 2, nan});
  ck_assert_double_eq(value_at<2>(grid, {1, 0.5}), 2);
  ck_assert_double_eq(value_at<2>(grid, {0.5, 1}), 1.5);
  quick_assert(std::isnan(value_at<2>(grid, {1.5, 0.5})));
}
END_TEST

// ------------------------------------------------------------------ errors ---------------------

START_TEST(bad_values_are_named) {
  const auto evaluate = [](double bad) {
    const auto spacing = spacing_of([bad](double x, double) { return x > 0.5 ? bad : 0.1; });
    const P x[] = {{0.25, 1}, {0.75, -3}, {0.875, 2}};
    double d[3];
    pnpbs::evaluate_spacing<2>(*spacing, 2.5, 3, x, d);
  };
  expect_error(pnpbs::ErrorKind::spacing, {"d = 0 at (0.75, -3)", "infinitely many nodes"},
               [&] { evaluate(0); });
  expect_error(pnpbs::ErrorKind::spacing, {"d = -2.5 at (0.75, -3)", "greater than 0"},
               [&] { evaluate(-2.5); });
  expect_error(pnpbs::ErrorKind::spacing, {"d = nan at (0.75, -3)", "not finite"},
               [&] { evaluate(std::numeric_limits<double>::quiet_NaN()); });
  expect_error(pnpbs::ErrorKind::spacing, {"d = inf at (0.75, -3)", "not finite"},
               [&] { evaluate(std::numeric_limits<double>::infinity()); });
  // 2 / sqrt(3) nodes per d^2 on an area of 2.5.
  expect_error(pnpbs::ErrorKind::spacing, {"d = 1e-09 at (0.75, -3)", "2886751345948", "larger d"},
               [&] { evaluate(1e-9); });
  expect_error(pnpbs::ErrorKind::spacing,
               {"d = 5e-324 at (0.75, -3)", "more nodes than can be counted"},
               [&] { evaluate(5e-324); });
  evaluate(1e-7);
  const P3 x{1, 2, 3};
  double d;
  expect_error(pnpbs::ErrorKind::spacing, {"at (1, 2, 3)", "about 15749"},
               [&] { pnpbs::evaluate_spacing<3>(pnpbs::ConstantSpacing<3>(1e-6), 1, 1, &x, &d); });
}
END_TEST

START_TEST(callbacks_that_fail) {
  const pnpbs::CallbackSpacing<2> spacing(
      [](std::int64_t, const double*, double*) { return std::int32_t{17}; });
  const P x[] = {{0, 0}, {1, 1}};
  double d[2];
  expect_error(pnpbs::ErrorKind::callback, {"returned 17", "2 points"},
               [&] { pnpbs::evaluate_spacing<2>(spacing, 1, 2, x, d); });
  const pnpbs::CallbackSpacing<2> counted([](std::int64_t n, const double* points, double*) {
    return static_cast<std::int32_t>(n == 0 && points == nullptr ? 0 : 1);
  });
  pnpbs::evaluate_spacing<2>(counted, 1, 0, nullptr, nullptr);
}
END_TEST

// ------------------------------------------------------------------ growth limit ---------------

// The limited d never exceeds d, is never below the exact limit and not much above it. Between any
// two points it grows at most at the limit, up to 5 % of d.
START_TEST(growth_limit_of_pits) {
  for (const double slope : {0.225, 0.5}) {
    for (const double max : {0.03, 0.2}) {
      const Pit pit{{0.31, 0.42}, 0.003, slope, max};
      const Limited limited(add_square, pit);
      Random random(93);
      for (int trial = 0; trial < 3000; ++trial) {
        const P x = random.point<2>(limited.domain.bounds());
        const double d = limited.at(x), exact = pit.limited(x, kGrowth);
        ck_assert_double_le(d, limited.raw_at(x));
        ck_assert_double_ge(d, exact * (1 - 1e-12));
        ck_assert_double_le(d, exact * 1.1);
        for (int other = 0; other < 10; ++other) {
          const double reach = std::pow(10, random.between(-4, 0));
          const P y{std::clamp(x[0] + random.between(-reach, reach), 0.0, 1.0),
                    std::clamp(x[1] + random.between(-reach, reach), 0.0, 1.0)};
          ck_assert_double_le(limited.at(y), d + kGrowth * pnpbs::distance<2>(x, y) + 0.05 * d);
        }
      }
    }
  }
}
END_TEST

// The exact limit beside a jump is that of a line, whatever the position of the leaves.
START_TEST(growth_limit_of_jumps) {
  constexpr double kFine = 0.004;
  for (const double jump : {0.5, 0.503, 0.561, 0.7499}) {
    const Limited limited(add_square, [=](double x, double) { return x > jump ? 1.0 : kFine; });
    Random random(95);
    double worst = 1, worst_beside = 1;
    for (int trial = 0; trial < 20000; ++trial) {
      const P x = random.point<2>(limited.domain.bounds());
      const double exact = kFine + kGrowth * std::max(0.0, x[0] - jump), d = limited.at(x);
      ck_assert_double_ge(d, exact * (1 - 1e-12));
      double& worst_here = x[0] > jump + 4 * kFine ? worst : worst_beside;
      worst_here = std::max(worst_here, d / exact);
    }
    ck_assert_double_le(worst, 1.34);
    ck_assert_double_le(worst_beside, 1.8);  // in the leaf of the jump, 4 d wide: by its samples
  }
}
END_TEST

// ------------------------------------------------------------------ steepest growth ------------

namespace {

pnpbs::SteepestGrowth<2> steepest_of(const Build& build, const Plane& d) {
  PlaneDomain domain;
  build(domain);
  domain.check();
  const pnpbs::SpacingEvaluator<2> spacing = [&](std::int64_t n, const P* x, double* values) {
    for (std::int64_t i = 0; i < n; ++i) values[i] = d(x[i][0], x[i][1]);
  };
  const pnpbs::Boundary boundary = pnpbs::discretize_boundary(domain, spacing);
  pnpbs::SizedTree<2> map;
  map.build(domain.bounds(), boundary, spacing, {1'000'000'000});
  return pnpbs::steepest_growth<2>(
      *pnpbs::serial_communicator(), map, [](std::int32_t) { return true; }, spacing);
}

}  // namespace

START_TEST(steepest_growth_of_slopes) {
  for (const double g : {0.05, 0.3, 1.0}) {
    const pnpbs::SteepestGrowth<2> even =
        steepest_of(add_square, [=](double x, double y) { return 0.02 + g * (0.6 * x + 0.8 * y); });
    // Slopes between samples to the east and to the north are 1.4 / sqrt(2) of the gradient.
    ck_assert_double_le(even.growth, g * (1 + 1e-9));
    ck_assert_double_ge(even.growth, 0.98 * g);
    const pnpbs::SteepestGrowth<2> cone = steepest_of(
        add_square, [=](double x, double y) { return 0.01 + g * std::hypot(x - 0.3, y - 0.6); });
    ck_assert_double_le(cone.growth, g * (1 + 1e-9));
    ck_assert_double_ge(cone.growth, 0.98 * g);
    ck_assert_double_le(pnpbs::distance<2>(cone.at, {0.3, 0.6}), 0.04);  // at its tip
  }
  ck_assert_double_eq(steepest_of(add_square, constant(0.1)).growth, 0);
}
END_TEST

// The growth is found for any position of the leaves, with its location.
START_TEST(steepest_growth_of_jumps) {
  for (const double jump : {0.5, 0.503, 0.561, 0.7499}) {
    const pnpbs::SteepestGrowth<2> steepest =
        steepest_of(add_square, [=](double x, double) { return x > jump ? 1.0 : 0.004; });
    ck_assert_double_ge(steepest.growth, 1);
    ck_assert_double_eq_tol(steepest.at[0], jump, 4 * 0.004);
  }
}
END_TEST

// Growth is not measured across a gap, but across an inner curve, whose nodes both sides share.
START_TEST(steepest_growth_of_two_sides) {
  const Build apart = [](PlaneDomain& p) {
    add_loop(p, rectangle(0, 0, 0.5, 1));
    add_loop(p, rectangle(0.503, 0, 1, 1));
  };
  const Build joined = [](PlaneDomain& p) {
    add_square(p);
    const std::vector<double> xy{0.5, 0, 0.5, 1};
    p.add_polyline(pnpbs::CurveRole::inner, false, 2, xy.data(), nullptr, 0);
  };
  const Plane jump = [](double x, double) { return x > 0.502 ? 0.2 : 0.02; };
  ck_assert_double_eq(steepest_of(apart, jump).growth, 0);
  for (const Build& build : {joined, Build(add_square)}) {
    const pnpbs::SteepestGrowth<2> steepest = steepest_of(build, jump);
    ck_assert_double_ge(steepest.growth, 0.5);
    ck_assert_double_eq_tol(steepest.at[0], 0.502, 0.08);
  }
}
END_TEST

START_TEST(growth_limit_leaves_alone_what_grows_slowly) {
  const Plane slow = [](double x, double y) { return 0.01 + 0.14 * std::hypot(x - 0.2, y - 0.7); };
  const Limited limited(add_square, slow);
  Random random(94);
  for (int trial = 0; trial < 3000; ++trial) {
    const P x = random.point<2>(limited.domain.bounds());
    quick_assert(limited.at(x) == limited.raw_at(x));
  }
  const Limited even(add_square, constant(0.05), 1e-3);
  quick_assert(even.at({0.3, 0.4}) == 0.05);
}
END_TEST

// A fine source at a boundary node counts as well. Paths lead through the domain, not across gaps.
START_TEST(growth_limit_goes_through_the_domain) {
  const Build horseshoe = [](PlaneDomain& p) {
    const std::vector<double> xy{0, 0, 1, 0, 1, 1, 0, 1, 0, 0.6, 0.8, 0.6, 0.8, 0.4, 0, 0.4};
    p.add_polyline(pnpbs::CurveRole::boundary, true, 8, xy.data(), nullptr, 0);
  };
  const double growth = 0.01, min = 0.004;
  const Limited limited(
      horseshoe, [=](double x, double y) { return x + y < 1e-3 ? min : 0.03; }, growth);
  // The path from the lower left corner around the bend, about 0.8, and back.
  const double bend = std::hypot(0.8, 0.4) + 0.2;
  for (const double x : {0.01, 0.2, 0.4}) {
    const double far = bend + 0.8 - x, near = std::hypot(x, 0.39);
    ck_assert_double_eq_tol(limited.at({x, 0.61}), min + growth * far, 0.1 * growth * far);
    ck_assert_double_eq_tol(limited.at({x, 0.39}), min + growth * near, 0.1 * growth * near);
  }
}
END_TEST

// d from many sources of different fineness, against the minimum over all of them.
START_TEST(growth_limit_of_many_sources) {
  struct Source {
    P x;
    double d;
  };
  Random random(96);
  std::vector<Source> sources;
  for (int k = 0; k < 40; ++k)
    sources.push_back({{random.between(0.05, 0.95), random.between(0.05, 0.95)},
                       0.002 * std::pow(10, random.between(0, 0.7))});
  const auto min_from = [&](const P& x, double slope) {
    double min = 0.2;
    for (const Source& source : sources)
      min = std::min(min, source.d + slope * pnpbs::distance<2>(x, source.x));
    return min;
  };
  const Limited limited(add_square, [&](double x, double y) { return min_from({x, y}, 0.6); });
  for (int trial = 0; trial < 10000; ++trial) {
    const P x = random.point<2>(limited.domain.bounds());
    const double d = limited.at(x), exact = min_from(x, kGrowth);
    ck_assert_double_ge(d, exact * (1 - 1e-12));
    ck_assert_double_le(d, exact * 1.1);
  }
}
END_TEST

namespace {

// The shortest path: straight, or past corners of a rectangular hole.
class WaysAround {
 public:
  WaysAround(P low, P high)
      : low_(low), high_(high), corners_{{low, {high[0], low[1]}, high, {low[0], high[1]}}} {}

  double operator()(const P& a, const P& b) const {
    double min = open(a, b) ? pnpbs::distance<2>(a, b) : 9;
    for (std::size_t c = 0; c < 4; ++c) {
      if (!open(a, corners_[c])) continue;
      const double there = pnpbs::distance<2>(a, corners_[c]);
      for (const std::size_t next : {c, (c + 1) % 4, (c + 3) % 4})
        if (open(corners_[next], b))
          min = std::min(min, there + pnpbs::distance<2>(corners_[c], corners_[next]) +
                                  pnpbs::distance<2>(corners_[next], b));
    }
    return min;
  }
  bool holds(const P& x) const {
    return x[0] > low_[0] && x[0] < high_[0] && x[1] > low_[1] && x[1] < high_[1];
  }

 private:
  // A segment crosses the hole if some part of it is between both pairs of sides.
  bool open(const P& a, const P& b) const {
    double begin = 0, end = 1;
    for (std::size_t k = 0; k < 2; ++k) {
      const double along = b[k] - a[k];
      if (along == 0 && (a[k] <= low_[k] || a[k] >= high_[k])) return true;
      if (along == 0) continue;
      const double first = (low_[k] - a[k]) / along, second = (high_[k] - a[k]) / along;
      begin = std::max(begin, std::min(first, second));
      end = std::min(end, std::max(first, second));
    }
    return end - begin < 1e-9;
  }

  P low_, high_;
  std::array<P, 4> corners_;
};

}  // namespace

// Paths behind a hole lead past its corners. They are not shorter, up to the width of a leaf or
// two, and not much longer. They are straight in sight of the source.
START_TEST(growth_limit_around_a_hole) {
  const P low{0.35, 0.2}, high{0.6, 0.7}, tip{0.2, 0.45};
  const WaysAround ways(low, high);
  const Build holed = [&](PlaneDomain& p) {
    add_square(p);
    add_loop(p, rectangle(low[0], low[1], high[0], high[1]));
  };
  constexpr double kMin = 0.003, kSlow = 0.02;
  const Limited limited(
      holed,
      [&](double x, double y) {
        return std::min(0.05, kMin + 0.5 * std::hypot(x - tip[0], y - tip[1]));
      },
      kSlow);
  Random random(97);
  int behind = 0;
  for (int trial = 0; trial < 10000; ++trial) {
    const P x = random.point<2>(limited.domain.bounds());
    if (ways.holds(x)) continue;
    const double straight = pnpbs::distance<2>(tip, x), way = ways(tip, x), d = limited.at(x);
    const double exact = kMin + kSlow * way;
    const bool hidden = way > 1.001 * straight;
    behind += hidden;
    ck_assert_double_ge(d, exact * (hidden ? 0.97 : 1 - 1e-12));
    ck_assert_double_le(d, exact * (hidden ? 1.08 : 1.03));
  }
  ck_assert_int_gt(behind, 1000);
}
END_TEST

START_TEST(growth_limit_reports_bad_values) {
  PlaneDomain domain;
  add_square(domain);
  domain.check();
  expect_error(pnpbs::ErrorKind::spacing, {"d = -1 at ("}, [&] {
    limited_spacing<2>(pnpbs::serial_communicator(),
                       line_of_sight(domain, *spacing_of(constant(0.1))),
                       spacing_of([](double x, double y) {
                         return std::hypot(x - 0.5, y - 0.5) < 0.3 ? -1 : 0.1;
                       }),
                       0.1, 1000000);
  });
  // A value that becomes invalid later, between the samples, is kept and detected by a later
  // evaluation.
  bool broken = false;
  const pnpbs::SizingField<2> limited = limited_spacing<2>(
      pnpbs::serial_communicator(), line_of_sight(domain, *spacing_of(constant(0.1))),
      spacing_of([&broken](double, double) { return broken ? std::nan("") : 0.1; }), 0.1, 1000000);
  broken = true;
  quick_assert(std::isnan(value_at<2>(limited, {0.5, 0.5})));
}
END_TEST

TEST_SUITE(test_spacing) {
  return run_kernel_suite(
      "spacing",
      {grids_are_linear_in_each_direction, grids_are_linear_only_between_neighbours,
       grids_know_their_low_points, grids_in_space_and_thin_ones, values_beside_a_hole_in_the_grid,
       bad_values_are_named, callbacks_that_fail, growth_limit_of_pits, growth_limit_of_jumps,
       steepest_growth_of_slopes, steepest_growth_of_jumps, steepest_growth_of_two_sides,
       growth_limit_leaves_alone_what_grows_slowly, growth_limit_goes_through_the_domain,
       growth_limit_of_many_sources, growth_limit_around_a_hole, growth_limit_reports_bad_values});
}
