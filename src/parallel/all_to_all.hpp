// SPDX-License-Identifier: BSD-3-Clause
// Messages from every rank to every rank.
#pragma once

#include <vector>

#include "parallel/communicator.hpp"
#include "parallel/records.hpp"

namespace pnpbs {

// Sends outgoing[r] to rank r, this one included; returns what the ranks sent, in their order.
// Collective.
inline std::vector<Bytes> exchange_with_all(const Communicator& comm, std::vector<Bytes> outgoing) {
  const auto me = static_cast<std::size_t>(comm.rank());
  Bytes own = std::move(outgoing[me]);
  outgoing.erase(outgoing.begin() + comm.rank());
  std::vector<int> others;
  for (int r = 0; r < comm.size(); ++r)
    if (r != comm.rank()) others.push_back(r);
  std::vector<Bytes> incoming = comm.exchange(others, outgoing);
  incoming.insert(incoming.begin() + comm.rank(), std::move(own));
  return incoming;
}

// Every record to the rank that rank_of(record) says. Collective.
template <class Record, class RankOf>
std::vector<Record> send_records(const Communicator& comm, std::vector<Record> records,
                                 const RankOf& rank_of) {
  if (comm.size() == 1) return records;
  std::vector<Bytes> messages(static_cast<std::size_t>(comm.size()));
  for (const Record& record : records)
    pack(messages[static_cast<std::size_t>(rank_of(record))], record);
  records = {};  // there may be many
  messages = exchange_with_all(comm, std::move(messages));
  for_records<Record>(messages, [&](const Record& record) { records.push_back(record); });
  return records;
}

}  // namespace pnpbs
