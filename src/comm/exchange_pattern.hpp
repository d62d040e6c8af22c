// SPDX-License-Identifier: BSD-3-Clause
// The halo exchange plan that copies values of owned nodes to their ghosts on other ranks. The
// library and the solvers of users follow it.
#pragma once

#include <cstdint>
#include <vector>

#include "comm/communicator.hpp"
#include "comm/records.hpp"

namespace pnpbs {

// A halo exchange plan of one rank.
struct ExchangePattern {
  std::vector<std::int32_t> ranks;  // ranks that exchange with this one, increasing
  // Compressed rows, one per rank: indices of the owned nodes to send and of the ghosts to receive.
  // Owned nodes are numbered first, then ghosts, both by increasing id.
  std::vector<std::int64_t> send_offsets, send_nodes, receive_offsets, receive_nodes;
};

// Builds the plan. `ids` has the ids of the owned nodes and then those of the ghosts, each in
// increasing order. `owners` has the owner of each ghost. Collective. Throws if a rank does not own
// a node that is its ghost elsewhere.
ExchangePattern make_exchange_pattern(const Communicator& comm, std::int64_t owned,
                                      const std::vector<std::int64_t>& ids,
                                      const std::vector<std::int32_t>& owners);

// Copies the values of the owned nodes to their ghosts. `values` has an entry per node and ghost.
// Collective.
template <class Value>
void fill_ghosts(const Communicator& comm, const ExchangePattern& pattern,
                 std::vector<Value>& values) {
  const auto at = [](std::int64_t k) { return static_cast<std::size_t>(k); };
  std::vector<Message> outgoing;
  for (std::size_t k = 0; k < pattern.ranks.size(); ++k) {
    outgoing.push_back({pattern.ranks[k], {}});
    for (std::int64_t s = pattern.send_offsets[k]; s < pattern.send_offsets[k + 1]; ++s)
      pack(outgoing.back().bytes, values[at(pattern.send_nodes[at(s)])]);
  }
  const std::vector<Message> incoming = comm.sparse_all_to_all(outgoing);
  std::size_t k = 0;
  for (const Message& message : incoming) {
    while (k < pattern.ranks.size() && pattern.ranks[k] != message.rank) ++k;
    if (k == pattern.ranks.size() ||
        message.bytes.size() !=
            sizeof(Value) * at(pattern.receive_offsets[k + 1] - pattern.receive_offsets[k]))
      throw Error(ErrorKind::internal, "rank " + std::to_string(message.rank) +
                                           " sent values of other nodes than the ghosts of this "
                                           "rank");
    std::int64_t next = pattern.receive_offsets[k];
    for_records<Value>(message.bytes, [&](const Value& value) {
      values[at(pattern.receive_nodes[at(next++)])] = value;
    });
  }
}

}  // namespace pnpbs
