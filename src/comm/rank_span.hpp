// SPDX-License-Identifier: BSD-3-Clause
// Contiguous global numbering of items over the ranks: the items of rank 0 come first, then those
// of rank 1, and so on.
#pragma once

#include <cstddef>
#include <cstdint>

#include "comm/communicator.hpp"

namespace pnpbs {

// The range of global numbers of this rank's items.
struct RankSpan {
  std::int64_t first = 0;  // number of the first item of this rank
  std::int64_t count = 0;  // number of items of this rank
  std::int64_t total = 0;  // number of items of all ranks
};

// Returns the range of this rank, which has `count` items. Collective.
inline RankSpan span_of(const Communicator& comm, std::size_t count) {
  RankSpan span;
  span.count = static_cast<std::int64_t>(count);
  span.first = comm.exclusive_scan(span.count);
  span.total = static_cast<std::int64_t>(comm.allreduce_sum(std::uint64_t{count}));
  return span;
}

}  // namespace pnpbs
