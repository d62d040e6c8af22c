// SPDX-License-Identifier: BSD-3-Clause
// Contiguous numbers of the nodes of all ranks in the order of their ids. The numbers are divided
// into one block of equal size per rank. They depend only on the ids and on the number of ranks.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "comm/rank_span.hpp"

namespace pnpbs {

// A distributed map between node ids and contiguous numbers.
class IdBlocks {
 public:
  // Builds the map. owned_id(k) is the id of the k-th node of this rank, in increasing order. An id
  // must not occur on two ranks. Collective. `comm` must outlive this object.
  IdBlocks(const Communicator& comm, std::int64_t owned,
           const std::function<std::int64_t(std::int64_t)>& owned_id);

  int rank_of(std::int64_t id) const;                // the rank whose block has the id
  const RankSpan& numbers() const { return span_; }  // the block of this rank

  // Returns the ids of the nodes with these numbers. All ranks must pass the same numbers.
  // Collective.
  std::vector<std::int64_t> ids_at(const std::vector<std::int64_t>& numbers) const;

  // Returns the numbers of the nodes with these ids, which may differ between ranks. Collective.
  // Throws if no rank owns an id.
  std::vector<std::int64_t> numbers_of(const std::vector<std::int64_t>& ids) const;

 private:
  std::int64_t number_in_block(std::int64_t id) const;

  const Communicator& comm_;
  std::vector<std::int64_t> begin_;  // [ranks - 1]: smallest id of each block but the first
  std::vector<std::int64_t> ids_;    // ids of this rank's block, increasing
  RankSpan span_;
};

}  // namespace pnpbs
