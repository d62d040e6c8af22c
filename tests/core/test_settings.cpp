// SPDX-License-Identifier: BSD-3-Clause
// The options of a placement, and the settings derived from them.
#include <string>

#include "geometry/expect_error.hpp"
#include "run_kernel_suite.hpp"
#include "settings/settings.hpp"

START_TEST(laws_and_options_agree) {
  const pnpbs::Settings settings{pnpbs::Options()};
  ck_assert_double_eq(settings.rest_length, pnpbs::LinearPush{}.range);
  const pnpbs::Settings in_space(pnpbs::Options(), 3);
  ck_assert_double_eq(in_space.rest_length, pnpbs::SmoothPush{}.range);
}
END_TEST

// The help of an option must contain its default in space if that differs, and also the default
// with effort=best if that differs again.
START_TEST(helps_name_both_defaults) {
  const pnpbs::Options in_plane, in_space = in_plane.in(3);
  pnpbs::Options with_best_effort;
  with_best_effort.set("effort", "best");
  const pnpbs::Options best = with_best_effort.in(3);
  int apart = 0, best_apart = 0;
  for (const pnpbs::OptionRow& row : pnpbs::option_table()) {
    const std::string help = row.help;
    if (row.type == pnpbs::OptionType::choice) continue;
    const bool whole = row.type == pnpbs::OptionType::integer;
    const bool differs = whole ? in_plane.integer(row.name) != in_space.integer(row.name)
                               : in_plane.real(row.name) != in_space.real(row.name);
    const std::size_t at = help.find("; default in space ");
    ck_assert_msg(differs == (at != std::string::npos), "%s: %s", row.name, row.help);
    if (!differs) continue;
    ++apart;
    const double told = std::stod(help.substr(at + 19));
    ck_assert_double_eq(
        told, whole ? static_cast<double>(in_space.integer(row.name)) : in_space.real(row.name));
    const std::string with = ", with effort=best ";
    const std::size_t at_best = help.find(with, at);
    const double best_value =
        whole ? static_cast<double>(best.integer(row.name)) : best.real(row.name);
    const bool named = at_best != std::string::npos;
    ck_assert_double_eq(named ? std::stod(help.substr(at_best + with.size())) : told, best_value);
    best_apart += named;
  }
  ck_assert_int_ge(apart, 12);
  ck_assert_int_ge(best_apart, 4);
}
END_TEST

// All ranks together may have 2^40 nodes.
START_TEST(numbers_of_nodes) {
  pnpbs::Options options;
  options.set("max_nodes", "1099511627776");
  ck_assert_int_eq(pnpbs::Settings(options).max_nodes, std::int64_t{1} << 40);
  options.set_integer("max_nodes", std::int64_t{1} << 40);
  options.set_real("wanted_nodes", 0x1p40);
  for (const char* name : {"max_nodes", "wanted_nodes"})
    expect_error(pnpbs::ErrorKind::argument, {name, "1099511627777", " .. 1099511627776"},
                 [&] { options.set(name, "1099511627777"); });
  ck_assert_int_eq(options.integer("max_nodes"), std::int64_t{1} << 40);
}
END_TEST

TEST_SUITE(test_settings) {
  return run_kernel_suite("settings",
                          {laws_and_options_agree, helps_name_both_defaults, numbers_of_nodes});
}
