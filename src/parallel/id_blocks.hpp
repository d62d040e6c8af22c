// SPDX-License-Identifier: BSD-3-Clause
// The nodes of all ranks in the order of their ids, cut into one block per rank of equal size:
// numbers without gaps, and who can tell them. Depends on the ids and the number of ranks only.
#pragma once

#include <cstdint>
#include <vector>

#include "parallel/rank_span.hpp"

namespace pnpbs {

class IdBlocks {
 public:
  // owned: ids of this rank's nodes, increasing; no id is on two ranks. Collective.
  IdBlocks(const Communicator& comm, const std::vector<std::int64_t>& owned);

  int rank_of(std::int64_t id) const;                // whose block it is in
  const RankSpan& numbers() const { return span_; }  // of this rank's block

  // The numbers of any nodes, by id. Collective.
  std::vector<std::int64_t> numbers_of(const std::vector<std::int64_t>& ids) const;

 private:
  std::int64_t number_in_block(std::int64_t id) const;

  const Communicator& comm_;
  std::vector<std::int64_t> begin_;  // [ranks - 1]: least id of each block but the first
  std::vector<std::int64_t> ids_;    // of this rank's block, increasing
  RankSpan span_;
};

}  // namespace pnpbs
