// SPDX-License-Identifier: BSD-3-Clause
// Records of nodes, elements and facets of a distributed mesh that ranks exchange, and the global
// numbers that identify them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "comm/records.hpp"

namespace pnpbs {

constexpr std::int64_t kNoElement = -1;

struct MeshNode {
  std::int64_t number, id;
  std::array<double, 3> x;
  std::int32_t tag;
};

// A triangle or tetrahedron with positive orientation. The corner with the smallest id comes first.
template <std::size_t Corners>
struct MeshElement {
  std::int64_t number;
  std::array<std::int64_t, Corners> corners;
  std::int32_t tag;  // of its region, 0 for none; on a surface mesh, of its patch
};

// A tagged side of elements. It has one element on the boundary and two on an inner curve or
// surface.
template <std::size_t Corners>
struct MeshFacet {
  std::array<std::int64_t, Corners - 1> corners;
  std::array<std::int64_t, 2> elements;  // smaller number first; the second may be kNoElement
  // Index of the corner opposite to the facet, in each element.
  std::array<std::int8_t, 2> opposite;
  std::int32_t tag;
};

// Sorts `records` by key(record) and keeps one record of each key.
template <class Record, class Key = std::identity>
void sort_and_keep_one(std::vector<Record>& records, const Key& key = {}) {
  std::ranges::sort(records, {}, key);
  const auto same = [&](const Record& a, const Record& b) { return key(a) == key(b); };
  records.erase(std::unique(records.begin(), records.end(), same), records.end());
}

// Contiguous number ranges of all ranks. This rank has the numbers from first() up to, but without,
// end().
class RankRanges {
 public:
  // Gives this rank `count` numbers. Collective.
  RankRanges(const Communicator& comm, std::int64_t count)
      : rank_(static_cast<std::size_t>(comm.rank())) {
    for (const std::int64_t n : of_all_ranks(comm, std::vector<std::int64_t>{count}))
      first_.push_back(first_.back() + n);
  }

  std::int64_t first() const { return first_[rank_]; }
  std::int64_t end() const { return first_[rank_ + 1]; }
  std::int64_t count() const { return end() - first(); }
  std::int64_t total() const { return first_.back(); }
  bool has(std::int64_t number) const { return first() <= number && number < end(); }
  int owner(std::int64_t number) const {
    if (has(number)) return static_cast<int>(rank_);  // the most frequent case
    return static_cast<int>(std::ranges::upper_bound(first_, number) - first_.begin()) - 1;
  }

 private:
  std::size_t rank_;
  std::vector<std::int64_t> first_{0};
};

// Requests records about `numbers` from the ranks that own these numbers. At the owner,
// give(number, requesting rank, answers) appends the records to `answers`. The records from one
// owner are sorted by key without repetition. Collective.
template <class Answer, class Give, class Key>
std::vector<Answer> query_owners(const Communicator& comm, const RankRanges& ranges,
                                 const std::vector<std::int64_t>& numbers, const Give& give,
                                 const Key& key) {
  Outbox questions;
  for (const std::int64_t number : numbers) pack(questions.to(ranges.owner(number)), number);
  Outbox answers;
  for (const Message& message : comm.sparse_all_to_all(questions.messages())) {
    std::vector<Answer> to_it;
    for_records<std::int64_t>(message.bytes,
                              [&](std::int64_t number) { give(number, message.rank, to_it); });
    sort_and_keep_one(to_it, key);
    Bytes& bytes = answers.to(message.rank);
    for (const Answer& one : to_it) pack(bytes, one);
  }
  return deliver<Answer>(comm, answers);
}

}  // namespace pnpbs
