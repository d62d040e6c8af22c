// SPDX-License-Identifier: BSD-3-Clause
// The nodes of all ranks in the order of their ids, cut into one block per rank of equal size:
// numbers without gaps, and who can tell them. Depends on the ids and the number of ranks only.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "comm/rank_span.hpp"

namespace pnpbs {

class IdBlocks {
 public:
  // owned_id(k): id of the k-th of this rank's nodes, increasing; no id is on two ranks.
  // Collective.
  IdBlocks(const Communicator& comm, std::int64_t owned,
           const std::function<std::int64_t(std::int64_t)>& owned_id);

  int rank_of(std::int64_t id) const;                // whose block it is in
  const RankSpan& numbers() const { return span_; }  // of this rank's block

  // The ids of the nodes with these numbers, the same ones on all ranks. Collective.
  std::vector<std::int64_t> ids_at(const std::vector<std::int64_t>& numbers) const;

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
