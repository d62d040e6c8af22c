// SPDX-License-Identifier: BSD-3-Clause
// Messages from every rank to every rank, by rank.
#pragma once

#include <utility>
#include <vector>

#include "comm/communicator.hpp"

namespace pnpbs {

// Sends outgoing[r] to rank r, this one included; returns what the ranks sent, in their order.
// Collective.
inline std::vector<Bytes> all_to_all(const Communicator& comm, std::vector<Bytes> outgoing) {
  std::vector<Message> messages;
  for (std::size_t r = 0; r < outgoing.size(); ++r)
    if (!outgoing[r].empty()) messages.push_back({static_cast<int>(r), std::move(outgoing[r])});
  std::vector<Bytes> incoming(outgoing.size());
  for (Message& message : comm.sparse_all_to_all(messages))
    incoming[static_cast<std::size_t>(message.rank)] = std::move(message.bytes);
  return incoming;
}

}  // namespace pnpbs
