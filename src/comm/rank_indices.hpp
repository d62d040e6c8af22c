// SPDX-License-Identifier: BSD-3-Clause
// Indices of ranks in a list of some of them. Memory grows with the length of the list, not with
// the number of ranks.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

namespace pnpbs {

// A map from ranks to list indices.
class RankIndices {
 public:
  // Returns the index of a rank, or -1 if it is not in the list.
  int of(int rank) const {
    const auto at = std::lower_bound(places_.begin(), places_.end(), std::pair(rank, 0));
    return at != places_.end() && at->first == rank ? at->second : -1;
  }

  // Adds a rank that is not in the list yet, and returns its index.
  int add(int rank) {
    const auto place = static_cast<int>(places_.size());
    const auto at = std::lower_bound(places_.begin(), places_.end(), std::pair(rank, 0));
    places_.insert(at, {rank, place});
    return place;
  }

 private:
  std::vector<std::pair<int, int>> places_;  // (rank, index), sorted by rank
};

}  // namespace pnpbs
