// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/distribution.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace pnpbs {

namespace {

// Which ranks need the nodes of each leaf, spread hop by hop: a leaf is needed by all who need one
// of its neighbours.
class Needs {
 public:
  Needs(const LeafGraph<2>& graph, const Distribution& distribution, std::int32_t leaves)
      : graph_(graph), distribution_(distribution), others_(static_cast<std::size_t>(leaves)) {
    for (std::int32_t leaf = 0; leaf < leaves; ++leaf) {
      bool at_rim = false;
      graph.for_neighbours(leaf, [&](std::int32_t other) {
        at_rim = at_rim || distribution.owner(other) != distribution.owner(leaf);
      });
      if (at_rim) front_.emplace_back(leaf, distribution.owner(leaf));
    }
  }

  void spread() {
    std::vector<std::pair<std::int32_t, std::int32_t>> next;
    for (const auto& [leaf, rank] : front_)
      graph_.for_neighbours(leaf, [&, r = rank](std::int32_t other) {
        std::vector<std::int32_t>& ranks = others_[static_cast<std::size_t>(other)];
        if (distribution_.owner(other) == r) return;
        if (std::find(ranks.begin(), ranks.end(), r) != ranks.end()) return;
        ranks.push_back(r);
        next.emplace_back(other, r);
      });
    front_ = std::move(next);
  }

  // Besides its owner, in increasing order.
  std::vector<std::int32_t> of(std::size_t leaf) const {
    std::vector<std::int32_t> ranks = others_[leaf];
    std::sort(ranks.begin(), ranks.end());
    return ranks;
  }

 private:
  const LeafGraph<2>& graph_;
  const Distribution& distribution_;
  std::vector<std::vector<std::int32_t>> others_;
  std::vector<std::pair<std::int32_t, std::int32_t>> front_;  // leaf and rank that came last
};

}  // namespace

std::vector<char> Distribution::cells_near_own(int hops, double reach) const {
  // A hop goes as far as a bubble reaches and to the far side of the leaf it finds there.
  const double hop = reach + 2;
  std::vector<double> reaches;
  for (std::int32_t c = 0; c < cells_.count(); ++c)
    reaches.push_back(hops * hop * cells_.largest_spacing(c));
  LeafGraph<2> near;
  near.build(cells_.tree(), reaches);
  std::vector<char> found(static_cast<std::size_t>(cells_.count()), 0);
  for (std::int32_t c = 0; c < cells_.count(); ++c)
    if (owner_of_cell(c) == rank_)
      near.for_neighbours(c, [&](std::int32_t n) { found[static_cast<std::size_t>(n)] = 1; });
  return found;
}

void Distribution::take_leaves(const BackgroundTree<2>& tree, const std::vector<char>& refined,
                               const std::function<double(std::int32_t)>& reach) {
  refined_ = refined;
  halos_.clear();
  cell_of_leaf_.clear();
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf)
    cell_of_leaf_.push_back(cells_.at(tree.cell_centre(tree.leaf_cell(leaf))));
  std::vector<double> reaches;
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) reaches.push_back(reach(leaf));
  graph_.build(tree, reaches);
}

std::vector<std::int32_t> Distribution::unrefined_within(int hops) const {
  const std::size_t leaves = cell_of_leaf_.size();
  std::vector<char> reached(leaves, 0);
  std::vector<std::int32_t> front, next;
  for (std::size_t leaf = 0; leaf < leaves; ++leaf) {
    reached[leaf] = owner(static_cast<std::int32_t>(leaf)) == rank_;
    if (reached[leaf]) front.push_back(static_cast<std::int32_t>(leaf));
  }
  std::set<std::int32_t> found;
  for (int hop = 0; hop < hops; ++hop) {
    next.clear();
    for (std::int32_t leaf : front)
      graph_.for_neighbours(leaf, [&](std::int32_t other) {
        if (reached[static_cast<std::size_t>(other)]) return;
        reached[static_cast<std::size_t>(other)] = 1;
        next.push_back(other);
        if (!refined(other)) found.insert(cell_of(other));
      });
    front.swap(next);
  }
  return {found.begin(), found.end()};
}

const Halo& Distribution::halo(int hops) {
  const auto known = halos_.find(hops);
  if (known != halos_.end()) return known->second;
  const auto leaves = static_cast<std::int32_t>(cell_of_leaf_.size());
  Needs needs(graph_, *this, leaves);
  for (int hop = 0; hop < hops; ++hop) needs.spread();
  Halo halo;
  halo.offset_.push_back(0);
  for (std::size_t leaf = 0; leaf < cell_of_leaf_.size(); ++leaf) {
    const std::vector<std::int32_t> ranks = needs.of(leaf);
    halo.ranks_.insert(halo.ranks_.end(), ranks.begin(), ranks.end());
    halo.offset_.push_back(static_cast<std::int32_t>(halo.ranks_.size()));
  }
  needs.spread();
  std::set<int> neighbours;
  for (std::int32_t leaf = 0; leaf < leaves; ++leaf) {
    if (!owns(leaf)) continue;
    const std::vector<std::int32_t> ranks = needs.of(static_cast<std::size_t>(leaf));
    neighbours.insert(ranks.begin(), ranks.end());
  }
  halo.neighbours_.assign(neighbours.begin(), neighbours.end());
  return halos_.emplace(hops, std::move(halo)).first->second;
}

std::vector<std::int64_t> Distribution::prefix_sums(const Communicator& comm,
                                                    std::vector<std::int64_t> counts,
                                                    std::int64_t& start) const {
  const auto cell = [this](std::size_t leaf) {
    return owner_.empty() ? 0 : static_cast<std::size_t>(cell_of_leaf_[leaf]);
  };
  std::vector<std::int64_t> next(static_cast<std::size_t>(cells_.count()), 0);
  for (std::size_t leaf = 0; leaf < counts.size(); ++leaf) next[cell(leaf)] += counts[leaf];
  comm.sum(next);
  for (std::int64_t& entry : next) entry = std::exchange(start, start + entry);
  // The leaves of a cell follow each other.
  for (std::size_t leaf = 0; leaf < counts.size(); ++leaf)
    counts[leaf] = std::exchange(next[cell(leaf)], next[cell(leaf)] + counts[leaf]);
  return counts;
}

}  // namespace pnpbs
