// SPDX-License-Identifier: BSD-3-Clause
// The places of some ranks in a list of them: takes memory for these, however many ranks there are.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

namespace pnpbs {

class RankPlaces {
 public:
  // -1 for a rank that has none.
  int of(int rank) const {
    const auto at = std::lower_bound(places_.begin(), places_.end(), std::pair(rank, 0));
    return at != places_.end() && at->first == rank ? at->second : -1;
  }

  // The next place, for a rank that has none yet.
  int add(int rank) {
    const auto place = static_cast<int>(places_.size());
    const auto at = std::lower_bound(places_.begin(), places_.end(), std::pair(rank, 0));
    places_.insert(at, {rank, place});
    return place;
  }

 private:
  std::vector<std::pair<int, int>> places_;  // ranks, increasing, and their places
};

}  // namespace pnpbs
