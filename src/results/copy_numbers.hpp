// SPDX-License-Identifier: BSD-3-Clause
// Numbers of copies of nodes over all ranks.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "comm/id_blocks.hpp"
#include "comm/records.hpp"
#include "results/results.hpp"

namespace pnpbs {

// In place of the number or index of a copy.
constexpr std::int64_t kOriginal = -1;

// An owned node with copies.
struct CopiedNode {
  std::int64_t place;      // result index
  std::int64_t copies;     // number of copies
  std::int64_t first = 0;  // number of the first copy
};

// Numbers the copies over all ranks in the order of the ids of the nodes, which are in this order
// on each rank. Returns the number of copies on all ranks. The nodes are distributed over the ranks
// by their ids for this. Collective.
template <int Dim>
std::int64_t number_copies(const Results<Dim>& results, std::vector<CopiedNode>& copied) {
  struct Record {
    std::int64_t id, copies, first;
    int rank;  // that owns the node
  };
  const Communicator& comm = results.communicator();
  const auto id = [&](std::int64_t place) {
    return results.level().nodes.id(results.node_at(place));
  };
  std::vector<Record> nodes;
  for (const CopiedNode& node : copied)
    nodes.push_back({id(node.place), node.copies, 0, comm.rank()});
  std::optional<IdBlocks> blocks;
  if (comm.size() > 1) {
    blocks.emplace(comm, results.count(), id);
    nodes = redistribute<Record>(comm, nodes,
                                 [&](const Record& node) { return blocks->rank_of(node.id); });
  }
  std::ranges::sort(nodes, {}, &Record::id);
  std::int64_t copies = 0;
  for (const Record& node : nodes) copies += node.copies;
  const RankSpan span = span_of(comm, static_cast<std::size_t>(copies));
  std::int64_t next = span.first;
  for (Record& node : nodes) {
    node.first = next;
    next += node.copies;
  }
  if (comm.size() > 1)
    nodes = redistribute<Record>(comm, nodes, [](const Record& node) { return node.rank; });
  std::ranges::sort(nodes, {}, &Record::id);  // as the copied nodes are
  for (std::size_t k = 0; k < copied.size(); ++k) copied[k].first = nodes[k].first;
  return span.total;
}

}  // namespace pnpbs
