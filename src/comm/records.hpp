// SPDX-License-Identifier: BSD-3-Clause
// Messages as rows of plain records.
#pragma once

#include <cstring>
#include <vector>

#include "comm/communicator.hpp"
#include "comm/rank_places.hpp"

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

// One message for each rank that gets anything.
class Outbox {
 public:
  Bytes& to(int rank) {
    // Records for one rank mostly come in a row.
    if (messages_.empty() || messages_[last_].rank != rank) last_ = place(rank);
    return messages_[last_].bytes;
  }
  const std::vector<Message>& messages() const { return messages_; }

 private:
  std::size_t place(int rank) {
    int place = places_.of(rank);
    if (place < 0) {
      place = places_.add(rank);
      messages_.push_back({rank, {}});
    }
    return static_cast<std::size_t>(place);
  }

  std::vector<Message> messages_;
  RankPlaces places_;
  std::size_t last_ = 0;
};

// Those of all ranks, rank by rank, on each of them. Collective.
template <class Record>
std::vector<Record> of_all_ranks(const Communicator& comm, const std::vector<Record>& own) {
  Bytes mine;
  for (const Record& record : own) pack(mine, record);
  std::vector<Record> all;
  for_records<Record>({comm.allgather(mine)}, [&](const Record& record) { all.push_back(record); });
  return all;
}

// Sends what is in the outbox, and returns the records that have come here, by rank. Collective.
template <class Record>
std::vector<Record> deliver(const Communicator& comm, const Outbox& outgoing) {
  std::vector<Record> arrived;
  for (const Message& message : comm.sparse_all_to_all(outgoing.messages()))
    for_records<Record>({message.bytes}, [&](const Record& record) { arrived.push_back(record); });
  return arrived;
}

// Brings each record to rank owner(record), from wherever it is, and returns what has come here.
// Collective.
template <class Record, class Owner>
std::vector<Record> redistribute(const Communicator& comm, const std::vector<Record>& records,
                                 const Owner& owner) {
  Outbox outgoing;
  for (const Record& record : records) pack(outgoing.to(owner(record)), record);
  return deliver<Record>(comm, outgoing);
}

}  // namespace pnpbs
