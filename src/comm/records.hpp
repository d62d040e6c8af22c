// SPDX-License-Identifier: BSD-3-Clause
// Messages as sequences of plain records.
#pragma once

#include <cstring>
#include <vector>

#include "comm/communicator.hpp"
#include "comm/rank_indices.hpp"

namespace pnpbs {

// Appends the bytes of a record to a message.
template <class Record>
void pack(Bytes& bytes, const Record& record) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof record);
  std::memcpy(bytes.data() + at, &record, sizeof record);
}

// Calls visit(record) for each record of a message.
template <class Record, class Visit>
void for_records(const Bytes& message, const Visit& visit) {
  for (std::size_t at = 0; at < message.size(); at += sizeof(Record)) {
    Record record;
    std::memcpy(&record, message.data() + at, sizeof record);
    visit(record);
  }
}

// Outgoing messages, one for each rank that receives anything.
class Outbox {
 public:
  // Returns the message to `rank`. The reference is valid until the next call.
  Bytes& to(int rank) {
    // Consecutive records mostly have the same destination.
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
  RankIndices places_;
  std::size_t last_ = 0;
};

// Returns the records of all ranks, sorted by rank, on each rank. Collective.
template <class Record>
std::vector<Record> of_all_ranks(const Communicator& comm, const std::vector<Record>& own) {
  Bytes mine;
  for (const Record& record : own) pack(mine, record);
  std::vector<Record> all;
  for_records<Record>(comm.allgather(mine), [&](const Record& record) { all.push_back(record); });
  return all;
}

// Sends the messages of the outbox and returns the received records, sorted by rank of the sender.
// Collective.
template <class Record>
std::vector<Record> deliver(const Communicator& comm, const Outbox& outgoing) {
  std::vector<Record> arrived;
  for (const Message& message : comm.sparse_all_to_all(outgoing.messages()))
    for_records<Record>(message.bytes, [&](const Record& record) { arrived.push_back(record); });
  return arrived;
}

// Sends each record to rank owner(record) and returns the received records. Collective.
template <class Record, class Owner>
std::vector<Record> redistribute(const Communicator& comm, const std::vector<Record>& records,
                                 const Owner& owner) {
  Outbox outgoing;
  for (const Record& record : records) pack(outgoing.to(owner(record)), record);
  return deliver<Record>(comm, outgoing);
}

}  // namespace pnpbs
