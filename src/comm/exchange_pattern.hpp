// SPDX-License-Identifier: BSD-3-Clause
// How values at nodes reach their ghosts on other ranks: the plan of an exchange, for us and for
// the user's solver.
#pragma once

#include <cstdint>
#include <vector>

#include "comm/communicator.hpp"
#include "comm/records.hpp"

namespace pnpbs {

struct ExchangePattern {
  std::vector<std::int32_t> ranks;  // who sends to us or gets from us, in increasing order
  // Compressed rows, one per rank: places of owned nodes to send, and of ghosts to fill (owned
  // nodes come first, then ghosts), both by increasing id.
  std::vector<std::int64_t> send_offsets, send_nodes, receive_offsets, receive_nodes;
};

// ids: of the owned nodes, in increasing order, then of the ghosts, in increasing order; owners: of
// the ghosts. Collective.
ExchangePattern make_exchange_pattern(const Communicator& comm, std::int64_t owned,
                                      const std::vector<std::int64_t>& ids,
                                      const std::vector<std::int32_t>& owners);

// Fills the values of the ghosts with those of their owners. Collective.
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
    for_records<Value>({message.bytes}, [&](const Value& value) {
      values[at(pattern.receive_nodes[at(next++)])] = value;
    });
  }
}

}  // namespace pnpbs
