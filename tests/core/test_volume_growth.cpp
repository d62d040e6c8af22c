// SPDX-License-Identifier: BSD-3-Clause
// The growth limit in space: straight distances without obstacles, and the path around an edge.
#include <cmath>
#include <memory>

#include "comm/communicator.hpp"
#include "limited_spacing.hpp"
#include "random.hpp"
#include "run_kernel_suite.hpp"
#include "volume_growth.hpp"

using P3 = pnpbs::Point<3>;
using volume_growth::Block;

namespace {

double value_at(const pnpbs::Spacing<3>& spacing, const P3& x) {
  double d;
  spacing.evaluate(1, &x, &d);
  return d;
}

// Expects a value that is at most d itself, and between `min` and `max` times the exact limit.
void expect_limited(const Block& block, double min, double max, std::uint64_t seed) {
  const pnpbs::SizingField<3> limited = limited_spacing<3>(
      pnpbs::serial_communicator(), block.ways(), block.spacing(), Block::kGrowth, 1'000'000'000);
  Random random(seed);
  int tried = 0;
  while (tried < 4000) {
    const P3 x = random.point<3>(block.bounds());
    if (!block.inside(x)) continue;
    ++tried;
    const double d = value_at(limited, x), exact = block.limit(x);
    ck_assert_double_le(d, block.raw(x));
    ck_assert_double_ge(d, min * exact);
    ck_assert_double_le(d, max * exact);
  }
}

}  // namespace

START_TEST(limit_in_the_open) {
  expect_limited(Block(false, {0.31, 0.42, 0.57}), 1 - 1e-12, 1.1, 610);
  expect_limited(Block(false, {0, 1, 0.5}), 1 - 1e-12, 1.1, 611);
}
END_TEST

// Paths from leaf to leaf may cut the edge by a part of a leaf, or be up to 8 % too long.
START_TEST(limit_around_an_edge) { expect_limited(Block(true, {0.9, 0.3, 0.2}), 0.99, 1.1, 612); }
END_TEST

TEST_SUITE(test_volume_growth) {
  return run_kernel_suite("growth limit in space", {limit_in_the_open, limit_around_an_edge});
}
