// SPDX-License-Identifier: BSD-3-Clause
// Messages as rows of plain records.
#pragma once

#include <cstring>
#include <vector>

#include "comm/communicator.hpp"

namespace pnpbs {

template <class Record>
void pack(Bytes& bytes, const Record& record) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof record);
  std::memcpy(bytes.data() + at, &record, sizeof record);
}

template <class Record, class Visit>
void for_records(const std::vector<Bytes>& messages, const Visit& visit) {
  for (const Bytes& bytes : messages)
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(Record)) {
      Record record;
      std::memcpy(&record, bytes.data() + at, sizeof record);
      visit(record);
    }
}

// Brings each record to rank owner(record), from wherever it is, and returns what has come here.
// Collective.
template <class Record, class Owner>
std::vector<Record> redistribute(const Communicator& comm, const std::vector<Record>& records,
                                 const Owner& owner) {
  std::vector<Record> arrived;
  std::vector<Message> messages;
  std::vector<int> message_for(static_cast<std::size_t>(comm.size()), -1);
  for (const Record& record : records) {
    const int r = owner(record);
    int& message = message_for[static_cast<std::size_t>(r)];
    if (message < 0) {
      message = static_cast<int>(messages.size());
      messages.push_back({r, {}});
    }
    pack(messages[static_cast<std::size_t>(message)].bytes, record);
  }
  for (const Message& message : comm.sparse_all_to_all(messages))
    for_records<Record>({message.bytes}, [&](const Record& record) { arrived.push_back(record); });
  return arrived;
}

// Place of each rank among the neighbours, -1 for the others.
inline std::vector<int> places_of(const std::vector<int>& neighbours, int size) {
  std::vector<int> place(static_cast<std::size_t>(size), -1);
  for (std::size_t k = 0; k < neighbours.size(); ++k)
    place[static_cast<std::size_t>(neighbours[k])] = static_cast<int>(k);
  return place;
}

}  // namespace pnpbs
