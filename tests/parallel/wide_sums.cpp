// SPDX-License-Identifier: BSD-3-Clause
// Tests sums over ranks beyond 64 bits against sums that each rank computes alone. Also tests
// running sums over cells, in which the fractions must be kept.
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "base/fixed_point.hpp"
#include "partition/cell_sums.hpp"
#include "rank_checks.hpp"

namespace {

using pnpbs::CellSum;
using pnpbs::FixedPointSum;
using rank_checks::comm;
using rank_checks::expect;

__extension__ using Whole = __int128;

constexpr int kDoublings = 90;

// Returns a term of the sum of a rank. The sum is then doubled `doublings` times.
double term(int rank, int k) {
  return std::ldexp(1.0 + (7 * rank + k) % 11, k - 30) * (rank % 3 == 2 ? -1 : 1);
}
FixedPointSum sum_of_rank(int rank, int doublings) {
  FixedPointSum sum;
  for (int k = 0; k < 5; ++k) sum.add(term(rank, k));
  for (int n = 0; n < doublings; ++n) sum.add(FixedPointSum(sum));
  return sum;
}

// Returns the sum of all ranks in units of 2^-32.
Whole sum_of_ranks(int doublings) {
  Whole sum = 0;
  for (int rank = 0; rank < comm->size(); ++rank)
    for (int k = 0; k < 5; ++k) sum += static_cast<Whole>(std::ldexp(term(rank, k), 32));
  return sum * (Whole{1} << doublings);
}

void check_sums() {
  std::vector<std::int64_t> counts;
  std::vector<FixedPointSum> sums;
  for (int doublings = 0; doublings < kDoublings; ++doublings) {
    const FixedPointSum mine = sum_of_rank(comm->rank(), doublings);
    counts.push_back(comm->rank() + doublings);
    sums.push_back(mine);
    expect(comm->allreduce_sum(mine).units().value() == sum_of_ranks(doublings),
           "a sum of terms doubled " + std::to_string(doublings) + " times");
  }
  comm->allreduce_sum(counts, sums);
  const std::int64_t size = comm->size();
  for (int doublings = 0; doublings < kDoublings; ++doublings) {
    const auto k = static_cast<std::size_t>(doublings);
    expect(counts[k] == size * (size - 1) / 2 + size * doublings, "a count beside sums");
    expect(sums[k].units().value() == sum_of_ranks(doublings),
           "one of many sums, doubled " + std::to_string(doublings) + " times");
  }
}

// Checks a running sum over cells, each of which has 2^30 nodes and a fraction.
void check_running_sums() {
  constexpr std::int64_t kCells = 1000, kPart = 12345678901;
  constexpr std::int64_t kInCell = (std::int64_t{1} << 62) + kPart;
  std::vector<CellSum> own;
  for (std::int64_t cell = comm->rank(); cell < kCells; cell += comm->size())
    own.push_back({cell, kInCell});
  std::int64_t end = 0;
  const std::vector<std::int64_t> before = pnpbs::cell_prefix_sums(*comm, kCells, own, end);
  for (std::size_t k = 0; k < own.size(); ++k)
    expect(pnpbs::fraction_of(before[k]) == own[k].cell * kPart % (std::int64_t{1} << 32),
           "the fraction before cell " + std::to_string(own[k].cell));
  expect(pnpbs::fraction_of(end) == kCells * kPart % (std::int64_t{1} << 32), "that of all");
}

void check_all() {
  check_sums();
  check_running_sums();
}

}  // namespace

int main(int argc, char** argv) { return rank_checks::run_in_groups(argc, argv, check_all); }
