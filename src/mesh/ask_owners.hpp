// SPDX-License-Identifier: BSD-3-Clause
// Questions about numbers, which the ranks that own them answer.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh_records.hpp"
#include "mesh/rank_ranges.hpp"

namespace pnpbs {

// answer(number, rank that asks, answers) adds the answers to `answers`, at the owner; answers that
// one rank gets from another are sorted by key, and come once. Collective.
template <class Answer, class Give, class Key>
std::vector<Answer> ask_owners(const Communicator& comm, const RankRanges& ranges,
                               const std::vector<std::int64_t>& numbers, const Give& give,
                               const Key& key) {
  Outbox questions;
  for (const std::int64_t number : numbers) pack(questions.to(ranges.owner(number)), number);
  Outbox answers;
  for (const Message& message : comm.sparse_all_to_all(questions.messages())) {
    std::vector<Answer> to_it;
    for_records<std::int64_t>({message.bytes},
                              [&](std::int64_t number) { give(number, message.rank, to_it); });
    sort_and_keep_one(to_it, key);
    Bytes& bytes = answers.to(message.rank);
    for (const Answer& one : to_it) pack(bytes, one);
  }
  return deliver<Answer>(comm, answers);
}

}  // namespace pnpbs
