// SPDX-License-Identifier: BSD-3-Clause
// Messages as rows of plain records.
#pragma once

#include <cstring>
#include <vector>

#include "parallel/communicator.hpp"

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

// Place of each rank among the neighbours, -1 for the others.
inline std::vector<int> places_of(const std::vector<int>& neighbours, int size) {
  std::vector<int> place(static_cast<std::size_t>(size), -1);
  for (std::size_t k = 0; k < neighbours.size(); ++k)
    place[static_cast<std::size_t>(neighbours[k])] = static_cast<int>(k);
  return place;
}

}  // namespace pnpbs
