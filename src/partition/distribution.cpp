// SPDX-License-Identifier: BSD-3-Clause
#include "partition/distribution.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "base/fixed_point.hpp"
#include "partition/cell_sums.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

namespace {

// The ranks that need the nodes of each leaf as ghosts. Each call of spread() adds one hop: a rank
// that needs a leaf needs its neighbours, too.
template <int Dim>
class Needs {
 public:
  Needs(const LeafGraph<Dim>& graph, const Distribution<Dim>& distribution, std::int32_t leaves)
      : graph_(graph), distribution_(distribution), others_(static_cast<std::size_t>(leaves)) {
    // Start with the leaves that have a neighbour of another holder.
    std::vector<char> at_rim(others_.size(), 0);
    for (std::int32_t leaf = 0; leaf < leaves; ++leaf) {
      if (distribution.holds(leaf)) continue;
      graph.for_neighbours(leaf, [&](std::int32_t other) {
        if (distribution.holder(other) == distribution.holder(leaf)) return;
        for (const std::int32_t end : {leaf, other}) {
          if (at_rim[static_cast<std::size_t>(end)] || distribution.holder(end) < 0) continue;
          at_rim[static_cast<std::size_t>(end)] = 1;
          front_.emplace_back(end, distribution.holder(end));
        }
      });
    }
  }

  void spread() {
    std::vector<std::pair<std::int32_t, std::int32_t>> next;
    for (const auto& [leaf, rank] : front_)
      graph_.for_neighbours(leaf, [&, r = rank](std::int32_t other) {
        std::vector<std::int32_t>& ranks = others_[static_cast<std::size_t>(other)];
        if (distribution_.holder(other) == r) return;
        if (std::find(ranks.begin(), ranks.end(), r) != ranks.end()) return;
        ranks.push_back(r);
        next.emplace_back(other, r);
      });
    front_ = std::move(next);
  }

  // Returns the ranks besides the holder that need the leaf, in increasing order.
  const std::vector<std::int32_t>& of(std::size_t leaf) {
    std::sort(others_[leaf].begin(), others_[leaf].end());
    return others_[leaf];
  }

 private:
  const LeafGraph<Dim>& graph_;
  const Distribution<Dim>& distribution_;
  std::vector<std::vector<std::int32_t>> others_;
  std::vector<std::pair<std::int32_t, std::int32_t>> front_;  // leaf and rank of the last hop
};

// Leaves of a tree that a search has not found yet, counted for each cell that contains them.
template <int Dim>
class UnfoundLeaves {
 public:
  explicit UnfoundLeaves(const BackgroundTree<Dim>& tree)
      : tree_(tree),
        parent_(static_cast<std::size_t>(tree.cell_count()), -1),
        left_(static_cast<std::size_t>(tree.cell_count()), 0) {
    for (std::int32_t c = 0; c < tree.cell_count(); ++c)
      for (int k = 0; tree.cell(c).first_child >= 0 && k < BackgroundTree<Dim>::kChildren; ++k)
        parent_[static_cast<std::size_t>(tree.cell(c).first_child + k)] = c;
    for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) add_from(leaf, 1);
  }

  bool any_in(std::int32_t cell) const { return left_[static_cast<std::size_t>(cell)] > 0; }
  bool found(std::int32_t leaf) const { return !any_in(tree_.leaf_cell(leaf)); }
  void find(std::int32_t leaf) {
    if (!found(leaf)) add_from(leaf, -1);
  }

 private:
  void add_from(std::int32_t leaf, std::int32_t more) {
    for (std::int32_t c = tree_.leaf_cell(leaf); c >= 0; c = parent_[static_cast<std::size_t>(c)])
      left_[static_cast<std::size_t>(c)] += more;
  }

  const BackgroundTree<Dim>& tree_;
  std::vector<std::int32_t> parent_, left_;
};

// Returns `leaves` and the leaves within `hops` hops of them. Marks all of them in `reached`.
template <int Dim>
std::vector<std::int32_t> reached_from(const LeafGraph<Dim>& graph,
                                       std::vector<std::int32_t> leaves, int hops,
                                       std::vector<char>& reached) {
  for (std::int32_t leaf : leaves) reached[static_cast<std::size_t>(leaf)] = 1;
  std::size_t first = 0;  // first leaf that the last hop reached
  for (int hop = 0; hop < hops; ++hop) {
    const std::size_t last = leaves.size();
    for (std::size_t k = first; k < last; ++k)
      graph.for_neighbours(leaves[k], [&](std::int32_t other) {
        if (reached[static_cast<std::size_t>(other)]) return;
        reached[static_cast<std::size_t>(other)] = 1;
        leaves.push_back(other);
      });
    first = last;
  }
  return leaves;
}

}  // namespace

// Searches in boxes and not in a graph of all cells, of which a rank needs only a small part if
// there are many ranks.
template <int Dim>
std::vector<char> Distribution<Dim>::cells_near_own(int hops, double reach) const {
  const BackgroundTree<Dim>& tree = cells_.tree();
  const auto box = [&](std::int32_t c) { return tree.cell_box(tree.leaf_cell(c)); };
  // A hop reaches as far as a bubble does, and then to the far side of the leaf there.
  const auto way = [&](std::int32_t c) { return hops * (reach + 2) * cells_.max_spacing(c); };
  UnfoundLeaves<Dim> left(tree);
  for (std::int32_t c = 0; c < cells_.count(); ++c)
    if (owner_of_cell(c) == rank_) left.find(c);
  constexpr double kNone = std::numeric_limits<double>::infinity();
  Box<Dim> around_own;
  around_own.low.fill(kNone);
  around_own.high.fill(-kNone);
  for (std::int32_t c = 0; c < cells_.count(); ++c) {
    if (owner_of_cell(c) != rank_ || empty(c)) continue;
    const Box<Dim> own = box(c);
    around_own = joined(around_own, own);
    tree.for_leaves_in(
        widened(own, way(c)), [&](std::int32_t cell) { return left.any_in(cell); },
        [&](std::int32_t n) {
          if (squared_gap<Dim>(own, box(n)) <= way(c) * way(c)) left.find(n);
        });
  }
  // Add the cells whose bubbles are so much larger than ours that only they reach as far.
  const std::vector<char> ours = cells_with_some_of(rank_);
  std::vector<char> found;
  for (std::int32_t c = 0; c < cells_.count(); ++c)
    found.push_back(left.found(c) || (squared_gap<Dim>(box(c), around_own) <= way(c) * way(c) &&
                                      near(box(c), ours, way(c))));
  return found;
}

template <int Dim>
void Distribution<Dim>::take_leaves(const BackgroundTree<Dim>* tree,
                                    const std::vector<char>& refined) {
  tree_ = tree;
  refined_ = refined;
  halos_.clear();
  cell_of_leaf_.clear();
  for (std::int32_t leaf = 0; leaf < tree->leaf_count(); ++leaf)
    cell_of_leaf_.push_back(cells_.at(tree->cell_centre(tree->leaf_cell(leaf))));
}

// Returns for each leaf the largest reach of a bubble within `hops` hops. Only the entries of
// `leaves` and of what lies within the hops around them are valid.
template <int Dim>
std::vector<double> Distribution<Dim>::reach_within(int hops,
                                                    std::vector<std::int32_t> leaves) const {
  std::vector<char> reached(cell_of_leaf_.size(), 0);
  leaves = reached_from(links_->graph, std::move(leaves), hops, reached);
  std::vector<double> max_reach = links_->reach, before;
  for (int hop = 0; hop < hops; ++hop) {
    before = max_reach;
    for (std::int32_t leaf : leaves)
      links_->graph.for_neighbours(leaf, [&](std::int32_t other) {
        double& max = max_reach[static_cast<std::size_t>(leaf)];
        max = std::max(max, before[static_cast<std::size_t>(other)]);
      });
  }
  return max_reach;
}

// Marks the cells of the partition's tree that contain a leaf that `rank` owns and that is not
// empty.
template <int Dim>
std::vector<char> Distribution<Dim>::cells_with_some_of(int rank) const {
  const BackgroundTree<Dim>& tree = cells_.tree();
  std::vector<char> some(static_cast<std::size_t>(tree.cell_count()), 0);
  for (std::int32_t c = tree.cell_count() - 1; c >= 0; --c) {  // children come after their parent
    const auto at = static_cast<std::size_t>(c);
    const auto& cell = tree.cell(c);
    if (cell.first_child < 0) some[at] = owner_of_cell(cell.leaf) == rank && !empty(cell.leaf);
    for (int k = 0; cell.first_child >= 0 && k < BackgroundTree<Dim>::kChildren; ++k)
      some[at] |= some[static_cast<std::size_t>(cell.first_child + k)];
  }
  return some;
}

// Returns whether a cell marked in `some`, see cells_with_some_of(), is within `way` of the box.
template <int Dim>
bool Distribution<Dim>::near(const Box<Dim>& box, const std::vector<char>& some, double way) const {
  bool found = false;
  const BackgroundTree<Dim>& tree = cells_.tree();
  tree.for_leaves_in(
      widened(box, way),
      [&](std::int32_t c) { return !found && some[static_cast<std::size_t>(c)] != 0; },
      [&](std::int32_t cell) {
        found = found || squared_gap<Dim>(box, tree.cell_box(tree.leaf_cell(cell))) <= way * way;
      });
  return found;
}

template <int Dim>
std::vector<char> Distribution<Dim>::leaves_within(int hops) const {
  const auto leaves = static_cast<std::int32_t>(cell_of_leaf_.size());
  std::vector<char> reached(static_cast<std::size_t>(leaves), 0);
  std::vector<std::int32_t> own;
  for (std::int32_t leaf = 0; leaf < leaves; ++leaf)
    if (holds(leaf)) own.push_back(leaf);
  reached_from(links_->graph, std::move(own), hops, reached);
  return reached;
}

template <int Dim>
std::vector<std::int32_t> Distribution<Dim>::unrefined_within(int hops) const {
  const std::vector<char> reached = leaves_within(hops);
  std::set<std::int32_t> found;
  for (std::int32_t leaf = 0; leaf < static_cast<std::int32_t>(reached.size()); ++leaf)
    if (reached[static_cast<std::size_t>(leaf)] && !refined(leaf)) found.insert(cell_of(leaf));
  return {found.begin(), found.end()};
}

template <int Dim>
const Halo& Distribution<Dim>::halo(int hops, double hop_share) {
  const auto known = halos_.find(hops);
  if (known != halos_.end()) return known->second;
  const auto leaves = static_cast<std::int32_t>(cell_of_leaf_.size());
  Needs<Dim> needs(links_->graph, *this, leaves);
  for (int hop = 0; hop < hops; ++hop) needs.spread();
  std::vector<std::int32_t> needed;
  for (std::int32_t leaf = 0; leaf < leaves; ++leaf)
    if (!needs.of(static_cast<std::size_t>(leaf)).empty()) needed.push_back(leaf);
  const std::vector<double> reach = reach_within(hops, std::move(needed));
  std::map<std::int32_t, std::vector<char>> cells_of;  // cells_with_some_of() for each rank
  const auto cells_with_some = [&](std::int32_t rank) -> const std::vector<char>& {
    std::vector<char>& some = cells_of[rank];
    if (some.empty()) some = cells_with_some_of(rank);
    return some;
  };
  Halo halo;
  halo.offset_.push_back(0);
  for (std::int32_t leaf = 0; leaf < leaves; ++leaf) {
    const Box<Dim> box = tree_->cell_box(tree_->leaf_cell(leaf));
    for (std::int32_t rank : needs.of(static_cast<std::size_t>(leaf)))
      if (holder(leaf) >= 0 && near(box, cells_with_some(rank),
                                    hops * hop_share * reach[static_cast<std::size_t>(leaf)]))
        halo.ranks_.push_back(rank);
    halo.offset_.push_back(static_cast<std::int32_t>(halo.ranks_.size()));
  }
  // A leaf that another rank holds or needs is not interior, nor are its neighbours.
  halo.interior_.assign(static_cast<std::size_t>(leaves), 1);
  for (std::int32_t leaf = 0; leaf < leaves; ++leaf) {
    const auto at = static_cast<std::size_t>(leaf);
    if (holder(leaf) < 0 || (holds(leaf) && halo.offset_[at] == halo.offset_[at + 1])) continue;
    links_->graph.for_neighbours(
        leaf, [&](std::int32_t other) { halo.interior_[static_cast<std::size_t>(other)] = 0; });
  }
  needs.spread();
  std::set<int> neighbours;
  for (std::int32_t leaf = 0; leaf < leaves; ++leaf) {
    if (!holds(leaf)) continue;
    const std::vector<std::int32_t>& ranks = needs.of(static_cast<std::size_t>(leaf));
    neighbours.insert(ranks.begin(), ranks.end());
  }
  halo.neighbours_.assign(neighbours.begin(), neighbours.end());
  return halos_.emplace(hops, std::move(halo)).first->second;
}

template <int Dim>
std::vector<std::int64_t> Distribution<Dim>::prefix_sums(const Communicator& comm,
                                                         std::vector<std::int64_t> counts,
                                                         std::int64_t& start) const {
  const auto cell = [this](std::size_t leaf) { return owner_.empty() ? 0 : cell_of_leaf_[leaf]; };
  // The leaves of a cell are contiguous, in the order of the cells.
  std::vector<CellSum> own;
  for (std::size_t leaf = 0; leaf < counts.size(); ++leaf) {
    const bool ours = owner_.empty() || owner_of_cell(cell(leaf)) == rank_;
    if (!ours && counts[leaf] == 0) continue;
    if (own.empty() || own.back().cell != cell(leaf)) own.push_back({cell(leaf), 0});
    own.back().sum = wrapping_sum(own.back().sum, counts[leaf]);
  }
  const std::vector<std::int64_t> before = cell_prefix_sums(comm, cells_.count(), own, start);
  std::size_t leaf = 0;
  for (std::size_t k = 0; k < own.size(); ++k) {
    while (cell(leaf) != own[k].cell) counts[leaf++] = 0;
    std::int64_t next = before[k];
    for (; leaf < counts.size() && cell(leaf) == own[k].cell; ++leaf)
      counts[leaf] = std::exchange(next, wrapping_sum(next, counts[leaf]));
  }
  std::fill(counts.begin() + static_cast<std::ptrdiff_t>(leaf), counts.end(), 0);
  return counts;
}

template class Distribution<2>;
template class Distribution<3>;

}  // namespace pnpbs
