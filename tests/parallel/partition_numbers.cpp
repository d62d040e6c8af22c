// SPDX-License-Identifier: BSD-3-Clause
// Tests numbers over the partition: running sums along its cells against sums over a table, with
// messages proportional to the cells of a rank; and the assignment of new parts to ranks, against a
// table of all parts and ranks.
#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/mixed_hash.hpp"
#include "message_counts.hpp"
#include "partition/cell_sums.hpp"
#include "partition/partition.hpp"
#include "rank_checks.hpp"

namespace {

using pnpbs::CellSum;
using pnpbs::KeptWork;
using rank_checks::comm;
using rank_checks::expect;

std::uint64_t number(std::uint64_t a, std::uint64_t b) { return pnpbs::mixed(pnpbs::mixed(a) ^ b); }

// ------------------------------------------------------------------ sums -----------------------

enum class Owners {
  random,   // random for each cell
  strips,   // along the order
  last,     // the last rank has all cells
  crowded,  // several ranks count in a cell
};

bool counts_in(Owners owners, int rank, std::int64_t cell, std::int64_t cells) {
  const auto size = static_cast<std::uint64_t>(comm->size());
  const std::uint64_t random = number(77, static_cast<std::uint64_t>(cell));
  switch (owners) {
    case Owners::random:
      return random % size == static_cast<std::uint64_t>(rank);
    case Owners::strips:
      return cell * comm->size() / cells == rank;
    case Owners::last:
      return rank == comm->size() - 1;
    case Owners::crowded:
      return (random >> rank) % 3 == 0;
  }
  return false;
}

// Returns the count of a rank in a cell. Some counts are zero, and some exceed 32 bits.
std::int64_t count_of(int rank, std::int64_t cell) {
  const std::uint64_t random =
      number(static_cast<std::uint64_t>(rank), static_cast<std::uint64_t>(cell));
  return random % 3 == 0 ? 0 : static_cast<std::int64_t>(random >> (random % 2 ? 20 : 58));
}

void check_sums(Owners owners, std::int64_t cells) {
  const std::string what = "sums over " + std::to_string(cells) + " cells";
  std::vector<CellSum> own;
  std::vector<std::int64_t> all(static_cast<std::size_t>(cells), 0);
  for (std::int64_t c = 0; c < cells; ++c)
    if (counts_in(owners, comm->rank(), c, cells)) {
      own.push_back({c, count_of(comm->rank(), c)});
      all[static_cast<std::size_t>(c)] = own.back().sum;
    }
  message_counts::counts = {};
  std::int64_t start = 11;
  const std::vector<std::int64_t> found = pnpbs::cell_prefix_sums(*comm, cells, own, start);
  const message_counts::Counts sent = message_counts::counts;

  comm->allreduce_sum(all);
  std::int64_t before = 11;
  for (std::int64_t& entry : all) entry = std::exchange(before, before + entry);
  expect(start == before, what + ": of all");
  expect(found.size() == own.size(), what + ": one for each of ours");
  for (std::size_t k = 0; k < std::min(found.size(), own.size()); ++k)
    expect(found[k] == all[static_cast<std::size_t>(own[k].cell)], what + ": before a cell");

  // A rank sends its requests, and the answers for the block of cells that it sums up.
  const std::int64_t asked = static_cast<std::int64_t>(own.size() * sizeof(CellSum));
  const std::int64_t block = (cells + comm->size() - 1) / comm->size() * comm->size() * 8;
  expect(sent.bytes <= asked + block, what + ": bytes sent");
  expect(sent.messages <= 2 * (comm->size() - 1), what + ": messages");
  expect(sent.longest <= 32, what + ": no table of all cells");
}

// ------------------------------------------------------------------ parts ----------------------

// Returns the assignment of parts to ranks by a complete table: kept[part * ranks + rank].
std::vector<int> ranks_by_table(const std::vector<std::int64_t>& kept, int ranks) {
  struct Match {
    std::int64_t work;
    int part, rank;
  };
  std::vector<Match> matches;
  for (int part = 0; part < ranks; ++part)
    for (int rank = 0; rank < ranks; ++rank)
      matches.push_back({kept[static_cast<std::size_t>(part * ranks + rank)], part, rank});
  std::stable_sort(matches.begin(), matches.end(),
                   [](const Match& a, const Match& b) { return a.work > b.work; });
  std::vector<int> rank_of(static_cast<std::size_t>(ranks), -1);
  std::vector<char> taken(static_cast<std::size_t>(ranks), 0);
  for (const Match& match : matches) {
    if (rank_of[static_cast<std::size_t>(match.part)] >= 0) continue;
    if (taken[static_cast<std::size_t>(match.rank)]) continue;
    rank_of[static_cast<std::size_t>(match.part)] = match.rank;
    taken[static_cast<std::size_t>(match.rank)] = 1;
  }
  return rank_of;
}

void check_parts(int ranks, std::uint64_t seed) {
  std::vector<std::int64_t> table(static_cast<std::size_t>(ranks * ranks), 0);
  std::vector<KeptWork> kept;
  std::vector<std::int32_t> cells;
  for (int part = 0; part < ranks; ++part)
    for (int rank = 0; rank < ranks; ++rank) {
      const std::uint64_t random = number(seed, static_cast<std::uint64_t>(part * ranks + rank));
      if (random % 4 != 0 || part % 7 == 3) continue;
      const auto work = static_cast<std::int64_t>((random >> 8) % 5);  // many are equal
      table[static_cast<std::size_t>(part * ranks + rank)] = work;
      if (work > 0) kept.push_back({work, part, rank});
    }
  std::sort(kept.begin(), kept.end(), [&](const KeptWork& a, const KeptWork& b) {
    return number(seed, static_cast<std::uint64_t>(a.part * ranks + a.rank)) <
           number(seed, static_cast<std::uint64_t>(b.part * ranks + b.rank));
  });
  for (int part = 0; part < ranks; ++part) cells.push_back(part);
  expect(pnpbs::renumbered_parts(cells, kept, ranks) == ranks_by_table(table, ranks),
         "ranks of " + std::to_string(ranks) + " parts");
}

void check_all() {
  for (const Owners owners : {Owners::random, Owners::strips, Owners::last, Owners::crowded})
    for (const std::int64_t cells : {1, 2, 7, 8, 9, 64, 5000}) check_sums(owners, cells);
  for (const int ranks : {1, 2, 3, 8, 40})
    for (std::uint64_t seed = 0; seed < 20; ++seed) check_parts(ranks, seed);
}

}  // namespace

int main(int argc, char** argv) { return rank_checks::run_in_groups(argc, argv, check_all); }
