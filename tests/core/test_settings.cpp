// SPDX-License-Identifier: BSD-3-Clause
// The defaults of the rules are those of the options that set them.
#include "run_kernel_suite.hpp"
#include "settings/settings.hpp"

START_TEST(rules_and_options_agree) {
  const pnpbs::Settings settings{pnpbs::Options()};
  const pnpbs::Motion motion;
  ck_assert_double_eq(settings.motion.dt, motion.dt);
  ck_assert_double_eq(settings.motion.damping, motion.damping);
  ck_assert_double_eq(settings.motion.max_move, motion.max_move);
  const pnpbs::PopulationRule population;
  ck_assert_double_eq(settings.population.delete_above, population.delete_above);
  ck_assert_double_eq(settings.population.insert_below, population.insert_below);
  ck_assert_double_eq(settings.population.mean_distance, population.mean_distance);
  ck_assert_double_eq(settings.rest_length, pnpbs::LinearPush{}.range);
  ck_assert_double_eq(settings.sweep.weight, pnpbs::SweepRule{}.weight);
  ck_assert_int_eq(settings.repair.rounds, pnpbs::RepairRule{}.rounds);
  ck_assert_double_eq(settings.repair.bad_below, pnpbs::RepairRule{}.bad_below);
  ck_assert_int_eq(settings.defects.rounds, pnpbs::DefectRule{}.rounds);
}
END_TEST

int main() { return run_kernel_suite("settings", {rules_and_options_agree}); }
