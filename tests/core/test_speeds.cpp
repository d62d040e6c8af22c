// SPDX-License-Identifier: BSD-3-Clause
// The speeds of the stop test, against a direct sum.
#include <cmath>

#include "level/speeds.hpp"
#include "level_run.hpp"
#include "run_kernel_suite.hpp"

namespace {

constexpr double kD = 0.1;

LevelRun square() {
  const auto unit_square = [](pnpbs::PlaneDomain& p) {
    shapes::add_loop(p, shapes::rectangle(0, 0, 1, 1));
  };
  LevelRun run(unit_square, constant(kD));
  fill_level(*run.level);
  return run;
}

// Returns the speed of the k-th inner node, in d per unit of time.
double speed_of(int k) { return 0.001 * k; }

int set_speeds(pnpbs::Nodes<2>& nodes) {
  int inner = 0;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    if (!nodes.moves(i)) continue;
    const double v = kD * speed_of(inner++);
    nodes.v[0](i) = 0.6 * v;
    nodes.v[1](i) = -0.8 * v;
  }
  return inner;
}

START_TEST(they_are_in_spacings) {
  const LevelRun run = square();
  const int inner = set_speeds(run.level->nodes);
  const pnpbs::Speeds speeds = pnpbs::speeds_of(*run.level);
  ck_assert_int_gt(inner, 20);
  ck_assert_double_lt(speed_of(inner), 0.15);
  ck_assert_double_eq_tol(speeds.mean, speed_of(inner - 1) / 2, 1e-9);
}
END_TEST

// Keeping a node off the boundary may move it farther than any force, back and forth without end.
// Such moves must not prevent the run from ending.
START_TEST(none_is_faster_than_a_force_makes_it) {
  const LevelRun run = square();
  pnpbs::Nodes<2>& nodes = run.level->nodes;
  const auto& motion = run.level->settings.motion;
  const double by_force = motion.max_move / motion.dt;
  const int inner = set_speeds(nodes);
  ck_assert_double_gt(speed_of(inner - 1), 2 * by_force);
  ck_assert_double_eq_tol(pnpbs::speeds_of(*run.level).max, by_force, 1e-12);
  for (std::int64_t i = 0; i < nodes.count; ++i)
    for (int k = 0; k < 2; ++k) nodes.v[k](i) *= 0.5 * by_force / speed_of(inner - 1);
  ck_assert_double_eq_tol(pnpbs::speeds_of(*run.level).max, 0.5 * by_force, 1e-12);
}
END_TEST

}  // namespace

TEST_SUITE(test_speeds) {
  return run_kernel_suite("speeds", {they_are_in_spacings, none_is_faster_than_a_force_makes_it});
}
