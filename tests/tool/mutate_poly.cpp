// SPDX-License-Identifier: BSD-3-Clause
// Tests hundreds of damaged .poly files. Reading and checking any file must give nodes, or an error
// with a message. It must never crash, hang or give invalid nodes.
//
// The text under test remains as mutate_poly.poly in the working folder after a crash. More damaged
// files, of each of three files, can be tested by hand:
// PNPBS_MUTATIONS=40000 PNPBS_SEED=7 mutate_poly
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "check_runner.h"
#include "damage.hpp"
#include "pnpbs/pnpbs.h"

namespace {

constexpr int nodes_across = 15;    // the spacing is the longer side of the domain divided by this
constexpr int full_run_every = 10;  // the other runs have a few steps only

const char* const square_with_hole = R"(# a square with a hole
8 2 0 1
1 0 0 1
2 1 0 1
3 1 1 1
4 0 1 1
5 0.3 0.3 2
6 0.6 0.3 2
7 0.6 0.6 2
8 0.3 0.6 2
8 1
1 1 2 1
2 2 3 1
3 3 4 1
4 4 1 1
5 5 6 2
6 6 7 2
7 7 8 2
8 8 5 2
1
1 0.45 0.45
)";

// Vertices are numbered from 0. Segment 4 begins in the middle of segment 0, and segment 5
// continues it.
const char* const t_junction = R"(7 2 1 0
0 -1 -1 0.5
1 1 -1 0.5
2 1 1 0.5
3 -1 1 0.5
4 0 -1 0.5
5 0.1 0.3 0.5
6 0.6 0.2 0.5
6 0
0 0 1
1 1 2
2 2 3
3 3 0
4 4 5
5 5 6
0
)";

std::string lake() {
  std::ifstream file(PNPBS_SOURCE_DIR "/examples/data/lake_victoria.poly");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

struct Tally {
  int refused_text = 0, refused_domain = 0, refused_spacing = 0, placed = 0;
};

// Expects that the status is one of the expected errors, and that there is a message.
void expect_refusal(pnpbs_context context, pnpbs_status status,
                    std::initializer_list<pnpbs_status> expected) {
  ck_assert_msg(std::find(expected.begin(), expected.end(), status) != expected.end(),
                "unexpected status %d: %s", static_cast<int>(status), pnpbs_last_error(context));
  ck_assert_msg(pnpbs_last_error(context)[0] != '\0', "a refusal without a message");
}

void examine_nodes(pnpbs_placement placement, const double* low, const double* high) {
  std::int64_t count = 0;
  ck_assert_int_eq(pnpbs_placement_count(placement, &count), PNPBS_OK);
  ck_assert_int_gt(count, 2);
  const auto size = static_cast<std::size_t>(count);
  std::vector<double> xy(2 * size), spacing(size);
  std::vector<std::int64_t> ids(size);
  ck_assert_int_eq(
      pnpbs_placement_get_nodes(placement, count, xy.data(), ids.data(), nullptr, spacing.data()),
      PNPBS_OK);
  for (std::size_t i = 0; i < 2 * size; ++i) {
    ck_assert(std::isfinite(xy[i]));
    ck_assert(xy[i] >= low[i % 2] && xy[i] <= high[i % 2]);
  }
  ck_assert(std::all_of(spacing.begin(), spacing.end(), [](double d) { return d > 0; }));
  ck_assert_uint_eq(std::set<std::int64_t>(ids.begin(), ids.end()).size(), size);

  std::int64_t triangles = 0;
  ck_assert_int_eq(pnpbs_placement_get_triangles(placement, 0, &triangles, nullptr), PNPBS_OK);
  std::vector<std::int64_t> corners(3 * static_cast<std::size_t>(triangles));
  ck_assert_int_eq(pnpbs_placement_get_triangles(placement, triangles, &triangles, corners.data()),
                   PNPBS_OK);
  ck_assert(std::all_of(corners.begin(), corners.end(),
                        [count](std::int64_t node) { return node >= 0 && node < count; }));
}

void examine_placement(pnpbs_context context, pnpbs_domain domain, bool full_run, Tally& tally) {
  double low[2], high[2];
  ck_assert_int_eq(pnpbs_domain_bounds(domain, low, high), PNPBS_OK);
  const double d = std::max(high[0] - low[0], high[1] - low[1]) / nodes_across;
  pnpbs_placement placement = nullptr;
  ck_assert_int_eq(pnpbs_placement_create(context, domain, &placement), PNPBS_OK);
  pnpbs_status status = pnpbs_placement_set_spacing_constant(placement, d);
  if (status >= 0) status = pnpbs_placement_initialise(placement);
  if (status >= 0) {
    status = full_run ? pnpbs_placement_run(placement) : pnpbs_placement_step(placement, 15);
    ck_assert_msg(status >= PNPBS_OK, "status %d: %s", static_cast<int>(status),
                  pnpbs_last_error(context));
    examine_nodes(placement, low, high);
    ++tally.placed;
  } else {
    expect_refusal(context, status, {PNPBS_ERROR_SPACING, PNPBS_ERROR_DOMAIN});
    ++tally.refused_spacing;
  }
  pnpbs_placement_destroy(&placement);
}

void examine(pnpbs_context context, const std::string& text, bool full_run, Tally& tally) {
  pnpbs_domain domain = nullptr;
  ck_assert_int_eq(pnpbs_domain_create(context, 2, &domain), PNPBS_OK);
  const pnpbs_status parsed = pnpbs_domain_parse_poly(
      domain, text.data(), static_cast<std::int64_t>(text.size()), "mutated.poly");
  if (parsed != PNPBS_OK) {
    expect_refusal(context, parsed, {PNPBS_ERROR_FILE, PNPBS_ERROR_DOMAIN});
    ++tally.refused_text;
  } else if (const pnpbs_status checked = pnpbs_domain_check(domain); checked != PNPBS_OK) {
    expect_refusal(context, checked, {PNPBS_ERROR_DOMAIN});
    ++tally.refused_domain;
  } else {
    examine_placement(context, domain, full_run, tally);
  }
  pnpbs_domain_destroy(&domain);
}

Tally examine_mutations(const std::string& seed_text, std::uint64_t seed) {
  pnpbs_context context = nullptr;
  ck_assert_int_eq(pnpbs_context_create_serial(&context), PNPBS_OK);
  const std::uint64_t mutations = from_environment("PNPBS_MUTATIONS", 600);
  Damage damage(seed + from_environment("PNPBS_SEED", 0));
  Tally tally;
  examine(context, seed_text, true, tally);
  ck_assert_msg(tally.placed == 1, "the undamaged text: %s", pnpbs_last_error(context));
  for (std::uint64_t i = 0; i < mutations; ++i) {
    const std::string text = damage.to(seed_text);
    std::ofstream(PNPBS_TEST_WORK_DIR "/mutate_poly.poly", std::ios::binary) << text;
    examine(context, text, i % full_run_every == 0, tally);
  }
  pnpbs_context_destroy(&context);
  std::printf("%d texts refused, %d domains refused, %d spacings refused, %d placed\n",
              tally.refused_text, tally.refused_domain, tally.refused_spacing, tally.placed);
  return tally;
}

// Expects that the damage reaches every stage. Otherwise the test would not cover it.
void expect_variety(const Tally& tally) {
  ck_assert_int_gt(tally.refused_text, 50);
  ck_assert_int_gt(tally.refused_domain, 20);
  ck_assert_int_gt(tally.placed, 50);
}

START_TEST(mutated_square) { expect_variety(examine_mutations(square_with_hole, 1)); }
END_TEST

START_TEST(mutated_t_junction) { expect_variety(examine_mutations(t_junction, 2)); }
END_TEST

START_TEST(mutated_lake) { expect_variety(examine_mutations(lake(), 3)); }
END_TEST

Suite* suite() {
  Suite* all = suite_create("mutate_poly");
  TCase* cases = tcase_create("mutations");
  tcase_set_timeout(cases, 0);
  tcase_add_test(cases, mutated_square);
  tcase_add_test(cases, mutated_t_junction);
  tcase_add_test(cases, mutated_lake);
  suite_add_tcase(all, cases);
  return all;
}

}  // namespace

TEST_SUITE(mutate_poly) { return run_suite(suite()); }
