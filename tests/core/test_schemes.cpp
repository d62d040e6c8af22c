// SPDX-License-Identifier: BSD-3-Clause
// Time steps against the exact solution of a damped oscillator: one bubble between two fixed ones.
// A linear push with a sufficient range exerts an exactly linear force.
#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>
#include <vector>

#include "bubbles.hpp"
#include "dynamics/pair_laws.hpp"
#include "dynamics/schemes.hpp"
#include "run_kernel_suite.hpp"

using pnpbs::Field;
using pnpbs::LinearPush;
using pnpbs::Motion;

namespace {

// Const nodes cannot be modified.
using ConstNodes = const pnpbs::Nodes<3>;
static_assert(std::is_assignable_v<decltype(std::declval<pnpbs::Nodes<3>>().x[0](0)), double>);
static_assert(!std::is_assignable_v<decltype(std::declval<ConstNodes>().x[0](0)), double>);
static_assert(!std::is_assignable_v<decltype(*std::declval<ConstNodes>().d.data()), double>);
static_assert(!std::is_assignable_v<decltype(std::declval<ConstNodes>().d.view()(0)), double>);

enum class Scheme { damped, predictor_corrector, runge_kutta };

template <int Dim>
struct Run {
  Bubbles<Dim> bubbles;
  Field<Dim> next;
  pnpbs::Stages<Dim> stages;

  explicit Run(const std::vector<Bubble<Dim>>& start, double radius) {
    bubbles.grow_tree([](const Point<Dim>&) { return 0.1; });
    bubbles.set(start);
    bubbles.list(radius);
    pnpbs::reserve_field<Dim>(next, "next", bubbles.nodes.capacity());
    bubbles.pad(next);
  }

  template <class Law>
  void step(Scheme scheme, const Law& law, const Motion& motion) {
    pnpbs::Nodes<Dim>& nodes = bubbles.nodes;
    if (scheme == Scheme::damped)
      pnpbs::damped_step<Dim>(nodes, bubbles.lists, law, motion, next);
    else if (scheme == Scheme::predictor_corrector)
      pnpbs::predictor_corrector_step<Dim>(nodes, bubbles.lists, law, motion, stages, next);
    else
      pnpbs::runge_kutta_step<Dim>(nodes, bubbles.lists, law, motion, stages, next);
    std::swap(nodes.x, next);
  }

  std::int64_t node(std::int64_t id) const {
    for (std::int64_t i = 0; i < bubbles.nodes.count; ++i)
      if (bubbles.nodes.id(i) == id) return i;
    ck_abort_msg("no such node");
    return -1;
  }
};

constexpr double kSpacing = 0.05, kHalf = 0.06, kStart = 0.04, kRange = 4, kDamping = 0.4;

// Returns the direction of the line through the three bubbles.
template <int Dim>
Point<Dim> direction() {
  Point<Dim> u;
  double square = 0;
  for (int k = 0; k < Dim; ++k) {
    u[k] = 1.0 + k;
    square += u[k] * u[k];
  }
  for (int k = 0; k < Dim; ++k) u[k] /= std::sqrt(square);
  return u;
}

template <int Dim>
Point<Dim> along(double s) {
  Point<Dim> x;
  for (int k = 0; k < Dim; ++k) x[k] = 0.5 + s * direction<Dim>()[k];
  return x;
}

// Returns the largest error of position and velocity over the amplitude after time 3 in n steps.
// With y the distance from the middle, the two pushes add up to f = -2 y / (range d). In scaled
// units the equation is y'' + c y' = d f.
template <int Dim>
double oscillator_error(Scheme scheme, int n) {
  Run<Dim> run({{along<Dim>(-kHalf), kSpacing, 0, false},
                {along<Dim>(kStart), kSpacing, 1, true},
                {along<Dim>(kHalf), kSpacing, 2, false}},
               kRange + 0.5);
  const Motion motion{3.0 / n, kDamping, 100};
  for (int step = 0; step < n; ++step) run.step(scheme, LinearPush{1, kRange}, motion);

  const double rate = std::sqrt(2 / kRange - kDamping * kDamping / 4), decay = kDamping / 2, t = 3;
  const double shape = std::cos(rate * t) + decay / rate * std::sin(rate * t);
  const double y = kStart * std::exp(-decay * t) * shape;
  const double v = -kStart * std::exp(-decay * t) * (2 / kRange) / rate * std::sin(rate * t);
  const std::int64_t i = run.node(1);
  double error = 0;
  for (int k = 0; k < Dim; ++k) {
    const double u = direction<Dim>()[k];
    error = std::max(error, std::fabs(run.bubbles.nodes.x[k](i) - 0.5 - y * u));
    error = std::max(error, std::fabs(run.bubbles.nodes.v[k](i) - v * u));
  }
  for (const std::int64_t fixed : {0, 2})
    ck_assert(run.bubbles.nodes.position(run.node(fixed)) == along<Dim>((fixed - 1.0) * kHalf));
  return error / kStart;
}

void expect_order(Scheme scheme, double order, double error_at_16) {
  double before = 0;
  for (const int n : {16, 32, 64, 128}) {
    const double error = oscillator_error<2>(scheme, n);
    ck_assert_double_eq_tol(oscillator_error<3>(scheme, n), error, 0.5 * error);
    if (n == 16) ck_assert_double_lt(error, error_at_16);
    if (n > 32) ck_assert_double_eq_tol(std::log2(before / error), order, 0.12);
    before = error;
  }
}

// Two strongly compressed bubbles, which would move much farther without a limit.
void expect_clamp(Scheme scheme) {
  const double d = 0.1;
  Run<2> run({{{0.5, 0.5}, d, 0}, {{0.503, 0.504}, d, 1}, {{0.503, 0.504}, 1e-9, 2, false}}, 1.7);
  const Motion motion{2, 0.2, 0.17};
  const pnpbs::CubicLaw law;
  std::vector<Point<2>> before;
  for (std::int64_t id = 0; id < 3; ++id)
    before.push_back(run.bubbles.nodes.position(run.node(id)));
  run.step(scheme, law, motion);
  for (const std::int64_t id : {0, 1}) {
    const std::int64_t i = run.node(id);
    const Point<2> x = run.bubbles.nodes.position(i);
    const double way = pnpbs::distance<2>(x, before[static_cast<std::size_t>(id)]);
    ck_assert_double_eq_tol(way, 0.17 * d, 1e-15);
    const double sign = id == 0 ? -1 : 1;
    ck_assert_double_eq_tol((x[0] - before[static_cast<std::size_t>(id)][0]) / way, sign * 0.6,
                            1e-9);
    ck_assert_double_eq_tol((x[1] - before[static_cast<std::size_t>(id)][1]) / way, sign * 0.8,
                            1e-9);
  }
  ck_assert(run.bubbles.nodes.position(run.node(2)) == before[2]);
}

// Returns the force on bubble i by the law for space, as a sum over all others.
Point<3> force_on(const std::vector<Bubble<3>>& all, std::size_t i) {
  Point<3> force{};
  for (std::size_t j = 0; j < all.size(); ++j) {
    const double gap = pnpbs::distance<3>(all[i].x, all[j].x);
    const double desired = (all[i].d + all[j].d) / 2, u = gap / (1.2 * desired);
    if (j == i || u >= 1) continue;
    const double f = desired * desired * (1 - u * u) * (1 - u * u);
    for (std::size_t k = 0; k < 3; ++k) force[k] += f * (all[i].x[k] - all[j].x[k]) / gap;
  }
  return force;
}

// Advances one bubble by a step of 0.6 with damping 0.2, the scheme for space.
void step_one(const Point<3>& force, const Bubble<3>& b, Point<3>& v, Point<3>& x) {
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    v[k] = b.moves ? (v[k] + 0.6 * force[k] / b.d) / (1 + 0.2 * 0.6) : 0;
    square += 0.36 * v[k] * v[k];
  }
  const double shorten = std::min(1.0, 0.2 * b.d / std::sqrt(std::max(square, 1e-300)));
  for (std::size_t k = 0; k < 3; ++k) {
    v[k] *= shorten;
    x[k] = b.x[k] + 0.6 * v[k];
  }
}

}  // namespace

// Bubbles of all sizes, some of which are fixed and some too fast.
START_TEST(volume_steps_as_one_bubble_after_the_other) {
  Random random(99);
  const SpacingFunction<3> d = [](const Point<3>& x) { return 0.05 + 0.1 * x[0]; };
  std::vector<Bubble<3>> all = random_bubbles<3>(random, 1003, d);
  for (std::size_t i = 0; i < all.size(); i += 9) all[i].moves = false;
  Run<3> run(all, 1.5);
  all = run.bubbles.bubbles();
  std::vector<Point<3>> v(all.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      v[i][k] = all[i].moves ? random.between(-0.1, 0.1) * all[i].d : 0;
      run.bubbles.nodes.v[k](static_cast<std::int64_t>(i)) = v[i][k];
    }
  run.step(Scheme::damped, pnpbs::DefaultLaw<3>{}, kMotionInSpace);
  int at_most = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    Point<3> x;
    step_one(force_on(all, i), all[i], v[i], x);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto node = static_cast<std::int64_t>(i);
      ck_assert_double_eq_tol(run.bubbles.nodes.x[k](node), x[k], 1e-14);
      ck_assert_double_eq_tol(run.bubbles.nodes.v[k](node), v[i][k], 1e-13);
    }
    at_most += pnpbs::distance<3>(x, all[i].x) > 0.199 * all[i].d;
  }
  ck_assert_int_gt(at_most, 50);
  ck_assert_int_lt(at_most, 850);
}
END_TEST

START_TEST(damped_step_is_of_first_order) { expect_order(Scheme::damped, 1, 0.2); }
END_TEST

START_TEST(predictor_corrector_is_of_second_order) {
  expect_order(Scheme::predictor_corrector, 2, 0.01);
}
END_TEST

START_TEST(runge_kutta_is_of_fourth_order) { expect_order(Scheme::runge_kutta, 4, 1e-4); }
END_TEST

// Bubbles of any size oscillate alike in scaled units: x / d is equal at equal times.
START_TEST(fine_and_coarse_bubbles_move_alike) {
  for (const Scheme scheme : {Scheme::damped, Scheme::predictor_corrector, Scheme::runge_kutta}) {
    double scaled[2];
    for (const int fine : {0, 1}) {
      const double d = fine ? 0.001 : 0.1;
      Run<2> run({{{0.5 - d, 0.5}, d, 0, false},
                  {{0.5 + 0.3 * d, 0.5}, d, 1},
                  {{0.5 + d, 0.5}, d, 2, false}},
                 1.7);
      for (int step = 0; step < 20; ++step)
        run.step(scheme, pnpbs::CubicLaw{}, Motion{0.8, 0.4, 0.2});
      scaled[fine] = (run.bubbles.nodes.x[0](run.node(1)) - 0.5) / d;
    }
    ck_assert_double_eq_tol(scaled[0], scaled[1], 1e-11);
    ck_assert_double_lt(std::fabs(scaled[0]), 0.1);  // damped towards the middle
  }
}
END_TEST

START_TEST(moves_are_clamped) {
  for (const Scheme scheme : {Scheme::damped, Scheme::predictor_corrector, Scheme::runge_kutta})
    expect_clamp(scheme);
}
END_TEST

START_TEST(clamp_keeps_short_moves) {
  std::array<double, 3> move{0.03, -0.04, 0};
  pnpbs::clamp_move<3>(move, 0.05 * (1 + 1e-15));
  ck_assert(move == (std::array<double, 3>{0.03, -0.04, 0}));
  pnpbs::clamp_move<3>(move, 0.005);
  ck_assert_double_eq_tol(move[0], 0.003, 1e-17);
  ck_assert_double_eq_tol(move[1], -0.004, 1e-17);
  std::array<double, 3> none{};
  pnpbs::clamp_move<3>(none, 0.1);
  ck_assert(none == (std::array<double, 3>{}));
}
END_TEST

TEST_SUITE(test_schemes) {
  return run_kernel_suite(
      "schemes",
      {damped_step_is_of_first_order, predictor_corrector_is_of_second_order,
       runge_kutta_is_of_fourth_order, fine_and_coarse_bubbles_move_alike, moves_are_clamped,
       clamp_keeps_short_moves, volume_steps_as_one_bubble_after_the_other});
}
