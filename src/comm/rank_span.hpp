// SPDX-License-Identifier: BSD-3-Clause
// Things numbered through over the ranks: those of rank 0 first, then those of rank 1, ...
#pragma once

#include <cstddef>
#include <cstdint>

#include "comm/communicator.hpp"

namespace pnpbs {

struct RankSpan {
  std::int64_t first = 0;  // number of this rank's first
  std::int64_t count = 0;  // of this rank
  std::int64_t total = 0;  // of all ranks
};

// Collective.
inline RankSpan span_of(const Communicator& comm, std::size_t count) {
  RankSpan span;
  span.count = static_cast<std::int64_t>(count);
  span.first = comm.exclusive_scan(span.count);
  span.total = static_cast<std::int64_t>(comm.allreduce_sum(std::uint64_t{count}));
  return span;
}

}  // namespace pnpbs
