// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "parallel/communicator.hpp"

namespace pnpbs {

// For one count per leaf of the background tree, on every rank those of its own nodes: the sum over
// all leaves before each one in Morton order, of all ranks, from `start` on; moves `start` on by
// the sum over all. What is numbered so does not depend on who owns which leaf. Collective.
inline std::vector<std::int64_t> prefix_sums(const Communicator& comm,
                                             std::vector<std::int64_t> counts,
                                             std::int64_t& start) {
  comm.sum(counts);
  for (std::int64_t& entry : counts) {
    const std::int64_t here = entry;
    entry = start;
    start += here;
  }
  return counts;
}

}  // namespace pnpbs
