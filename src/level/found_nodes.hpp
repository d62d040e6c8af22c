// SPDX-License-Identifier: BSD-3-Clause
// The nodes with some property, over all ranks: their number, and one example.
#pragma once

#include <cstdint>
#include <limits>

#include "base/types.hpp"
#include "comm/communicator.hpp"
#include "comm/records.hpp"

namespace pnpbs {

// The number of nodes found, and the position of the one with the smallest id.
template <int Dim>
struct FoundNodes {
  std::int64_t count = 0, id = std::numeric_limits<std::int64_t>::max();
  Point<Dim> at{};

  void add(std::int64_t more, std::int64_t of, const Point<Dim>& x) {
    if (more == 0) return;
    count += more;
    if (of >= id) return;
    id = of;
    at = x;
  }
};

// Combines the results of all ranks. Collective.
template <int Dim>
FoundNodes<Dim> over_ranks(const Communicator& comm, const FoundNodes<Dim>& own) {
  Bytes mine;
  pack(mine, own);
  FoundNodes<Dim> all;
  for_records<FoundNodes<Dim>>(comm.allgather(mine), [&](const FoundNodes<Dim>& found) {
    all.add(found.count, found.id, found.at);
  });
  return all;
}

}  // namespace pnpbs
