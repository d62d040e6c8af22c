// SPDX-License-Identifier: BSD-3-Clause
// Numbers that are contiguous by rank: a rank has those from first() to end().
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "comm/records.hpp"

namespace pnpbs {

class RankRanges {
 public:
  // Of this many on this rank. Collective.
  RankRanges(const Communicator& comm, std::int64_t count)
      : rank_(static_cast<std::size_t>(comm.rank())) {
    for (const std::int64_t n : of_all_ranks(comm, std::vector<std::int64_t>{count}))
      first_.push_back(first_.back() + n);
  }

  std::int64_t first() const { return first_[rank_]; }
  std::int64_t end() const { return first_[rank_ + 1]; }
  std::int64_t count() const { return end() - first(); }
  std::int64_t total() const { return first_.back(); }
  bool has(std::int64_t number) const { return first() <= number && number < end(); }
  int owner(std::int64_t number) const {
    if (has(number)) return static_cast<int>(rank_);  // mostly
    return static_cast<int>(std::ranges::upper_bound(first_, number) - first_.begin()) - 1;
  }

 private:
  std::size_t rank_;
  std::vector<std::int64_t> first_{0};
};

}  // namespace pnpbs
