// SPDX-License-Identifier: BSD-3-Clause
// Pairs of near nodes against a loop over all pairs: d varies by a factor of 100, some nodes do not
// count, and rows are in the order of ids for any order in memory.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "particles/near_nodes.hpp"
#include "random.hpp"
#include "run_kernel_suite.hpp"

using pnpbs::NearNodes;
using pnpbs::Point;

namespace {

constexpr double kRadius = 1.5;

template <int Dim>
void compare_with_all_pairs() {
  constexpr std::int32_t kCount = 600, kOwned = 400;
  Random random(Dim);
  std::vector<Point<Dim>> x(kCount);
  std::vector<double> d(kCount);
  std::vector<char> kept(kCount);
  std::vector<std::int64_t> ids(kCount);
  pnpbs::Box<Dim> box;
  box.low.fill(0), box.high.fill(1);
  for (std::size_t i = 0; i < kCount; ++i) {
    x[i] = random.point<Dim>(box);
    d[i] = 0.002 * std::pow(100, random.between(0, 1));
    kept[i] = random.below(5) != 0;
  }
  std::iota(ids.begin(), ids.end(), 7);
  random.shuffle(ids);
  const NearNodes<Dim> near(x, d, kept, kRadius);
  const auto rows = near_rows(near, kOwned, ids);
  std::size_t pairs = 0;
  for (std::int32_t i = 0; i < kOwned; ++i) {
    std::vector<std::int32_t> wanted;
    const std::size_t n = static_cast<std::size_t>(i);
    for (std::int32_t j = 0; j < kCount; ++j) {
      const std::size_t m = static_cast<std::size_t>(j);
      const double reach = kRadius * (d[n] + d[m]) / 2;
      if (j != i && kept[m] != 0 && pnpbs::distance<Dim>(x[n], x[m]) < reach) wanted.push_back(j);
    }
    std::ranges::sort(wanted, {}, [&](std::int32_t j) { return ids[static_cast<std::size_t>(j)]; });
    ck_assert(std::ranges::equal(rows.row(i), wanted));
    pairs += wanted.size();
  }
  ck_assert_uint_gt(pairs, kOwned);
}

START_TEST(in_the_plane) { compare_with_all_pairs<2>(); }
END_TEST

START_TEST(in_space) { compare_with_all_pairs<3>(); }
END_TEST

}  // namespace

TEST_SUITE(test_near_nodes) { return run_kernel_suite("near_nodes", {in_the_plane, in_space}); }
