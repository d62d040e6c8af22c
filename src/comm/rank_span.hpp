// SPDX-License-Identifier: BSD-3-Clause
// Things numbered through over the ranks: those of rank 0 first, then those of rank 1, ...
#pragma once

#include <cstdint>
#include <vector>

#include "comm/communicator.hpp"

namespace pnpbs {

struct RankSpan {
  std::int64_t first = 0;  // number of this rank's first
  std::int64_t count = 0;  // of this rank
  std::int64_t total = 0;  // of all ranks
};

// Collective.
inline RankSpan span_of(const Communicator& comm, std::size_t count) {
  std::vector<std::int64_t> counts(static_cast<std::size_t>(comm.size()));
  counts[static_cast<std::size_t>(comm.rank())] = static_cast<std::int64_t>(count);
  comm.allreduce_sum(counts);
  RankSpan span;
  span.count = static_cast<std::int64_t>(count);
  for (int r = 0; r < comm.size(); ++r) {
    if (r == comm.rank()) span.first = span.total;
    span.total += counts[static_cast<std::size_t>(r)];
  }
  return span;
}

}  // namespace pnpbs
