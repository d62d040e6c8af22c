// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/distribution.hpp"

#include <algorithm>
#include <set>

namespace pnpbs {

namespace {

using RankSets = std::vector<std::vector<std::int32_t>>;

// One hop: every leaf is needed by all who need one of its neighbours.
RankSets widened(const LeafGraph<2>& graph, const RankSets& sets) {
  RankSets wider = sets;
  for (std::size_t leaf = 0; leaf < sets.size(); ++leaf) {
    std::vector<std::int32_t>& own = wider[leaf];
    graph.for_neighbours(static_cast<std::int32_t>(leaf), [&](std::int32_t other) {
      for (std::int32_t r : sets[static_cast<std::size_t>(other)])
        if (std::find(own.begin(), own.end(), r) == own.end()) own.push_back(r);
    });
  }
  return wider;
}

}  // namespace

const Halo& Distribution::halo(int hops) {
  const auto known = halos_.find(hops);
  if (known != halos_.end()) return known->second;
  RankSets sets;
  for (std::int32_t r : owner_) sets.push_back({r});
  for (int hop = 0; hop < hops; ++hop) sets = widened(*graph_, sets);
  Halo halo;
  halo.offset_.push_back(0);
  for (std::vector<std::int32_t>& ranks : sets) {
    std::sort(ranks.begin(), ranks.end());
    halo.ranks_.insert(halo.ranks_.end(), ranks.begin(), ranks.end());
    halo.offset_.push_back(static_cast<std::int32_t>(halo.ranks_.size()));
  }
  sets = widened(*graph_, sets);
  std::set<int> neighbours;
  for (std::size_t leaf = 0; leaf < sets.size(); ++leaf)
    if (owner_[leaf] == rank_) neighbours.insert(sets[leaf].begin(), sets[leaf].end());
  neighbours.erase(rank_);
  halo.neighbours_.assign(neighbours.begin(), neighbours.end());
  return halos_.emplace(hops, std::move(halo)).first->second;
}

}  // namespace pnpbs
