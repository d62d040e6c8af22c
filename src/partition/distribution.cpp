// SPDX-License-Identifier: BSD-3-Clause
#include "partition/distribution.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "base/fixed_point.hpp"
#include "partition/cell_sums.hpp"
#include "partition/partition.hpp"
#include "tree/box_tree.hpp"
#include "tree/hop_search.hpp"

namespace pnpbs {

template <int Dim>
Distribution<Dim>::Distribution(PartitionCells<Dim> cells, std::vector<std::int32_t> owner,
                                int rank, int ranks)
    : cells_(std::move(cells)),
      images_(cells_.tree().periodic_cell(), ranks),
      owner_(std::move(owner)),
      rank_(rank),
      ranks_(ranks) {
  if (!images_.cell().any()) return;
  for (std::int32_t c = 0; c < cells_.count(); ++c)
    if (const Image<Dim> image = cells_.image_of(c); image != Image<Dim>{})
      owner_[static_cast<std::size_t>(c)] =
          images_.number(owner_of_cell(cells_.origin_of(c)), image);
}

template <int Dim>
Distribution<Dim> Distribution<Dim>::without_leaves() const {
  Distribution same;
  same.cells_ = cells_;
  same.images_ = images_;
  same.owner_ = owner_;
  same.rank_ = rank_;
  same.ranks_ = ranks_;
  return same;
}

template <int Dim>
double Distribution<Dim>::imbalance_of(const std::vector<std::int64_t>& work) const {
  std::vector<std::int32_t> ranks;
  for (const std::int32_t owner : owner_) ranks.push_back(images_.rank(owner));
  return imbalance(ranks, work, ranks_);
}

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

// Returns for each leaf the largest reach of a bubble within `hops` hops. Valid for the leaves
// within `hops` hops both of those that this rank holds and of those of other ranks near them.
// `from_own` and `from_others` have the number of hops from these, up to 2 * hops.
template <int Dim>
std::vector<double> Distribution<Dim>::reach_within(
    int hops, const std::vector<std::int32_t>& from_own,
    const std::vector<std::int32_t>& from_others) const {
  std::vector<double> max_reach = links_->reaches();
  for (int hop = 0; hop < hops; ++hop) {
    const std::vector<double> before = max_reach, in_cells = max_in_cells(*tree_, before);
    for (std::int32_t leaf = 0; leaf < tree_->leaf_count(); ++leaf) {
      const auto l = static_cast<std::size_t>(leaf);
      if (std::max(from_own[l], from_others[l]) >= 2 * hops - hop) continue;
      double& max = max_reach[l];
      if (holds(leaf)) {  // Lists of the nodes in it will read its row.
        links_->for_neighbours(leaf, [&](std::int32_t other) {
          max = std::max(max, before[static_cast<std::size_t>(other)]);
        });
        continue;
      }
      links_->search_neighbours(
          leaf, [&](std::int32_t cell) { return in_cells[static_cast<std::size_t>(cell)] > max; },
          [&](std::int32_t other) { max = before[static_cast<std::size_t>(other)]; });
    }
  }
  return max_reach;
}

// Marks the cells of the partition's tree that contain a leaf that `rank` owns and that is not
// empty.
template <int Dim>
std::vector<char> Distribution<Dim>::cells_with_some_of(int rank) const {
  std::vector<char> some;
  for (std::int32_t c = 0; c < cells_.count(); ++c)
    some.push_back(owner_of_cell(c) == rank && !empty(c));
  return max_in_cells(cells_.tree(), some);
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
std::vector<std::int32_t> Distribution<Dim>::hops_from_own(int hops) const {
  std::vector<std::int32_t> own;
  for (std::int32_t leaf = 0; leaf < tree_->leaf_count(); ++leaf)
    if (holds(leaf)) own.push_back(leaf);
  return hops_from(*links_, own, hops);
}

template <int Dim>
std::vector<std::int32_t> Distribution<Dim>::unrefined_within(int hops) const {
  const std::vector<std::int32_t> from_own = hops_from_own(hops);
  std::set<std::int32_t> found;
  for (std::int32_t leaf = 0; leaf < tree_->leaf_count(); ++leaf)
    if (from_own[static_cast<std::size_t>(leaf)] <= hops && !refined(leaf))
      found.insert(cell_of(leaf));
  return {found.begin(), found.end()};
}

// Returns the leaves of other ranks within `hops` hops of those of this rank, by rank.
template <int Dim>
std::map<int, std::vector<std::int32_t>> Distribution<Dim>::near_leaves_of_others(
    int hops, const std::vector<std::int32_t>& from_own) const {
  std::map<int, std::vector<std::int32_t>> leaves_of;
  for (std::int32_t leaf = 0; leaf < tree_->leaf_count(); ++leaf)
    if (from_own[static_cast<std::size_t>(leaf)] <= hops && holder(leaf) >= 0 && !holds(leaf))
      leaves_of[holder(leaf)].push_back(leaf);
  return leaves_of;
}

template <int Dim>
const Halo& Distribution<Dim>::halo(int hops, double hop_share) {
  const auto known = halos_.find(hops);
  if (known != halos_.end()) return known->second;
  const std::vector<std::int32_t> from_own = hops_from_own(2 * hops);
  const std::map<int, std::vector<std::int32_t>> of_others =
      near_leaves_of_others(hops + 1, from_own);
  std::vector<std::int32_t> others;
  for (const auto& [rank, leaves] : of_others)
    others.insert(others.end(), leaves.begin(), leaves.end());
  const std::vector<double> reach =
      reach_within(hops, from_own, hops_from(*links_, others, 2 * hops));
  const auto hops_to = [&](std::int32_t leaf) { return from_own[static_cast<std::size_t>(leaf)]; };
  Halo halo;
  std::vector<std::pair<std::int32_t, std::int32_t>> needs;  // a leaf and a rank that needs it
  const auto add = [&](std::int32_t leaf, int rank, const std::vector<char>& cells_with_some) {
    if (holder(leaf) >= 0 && holder(leaf) != rank &&
        near(tree_->cell_box(tree_->leaf_cell(leaf)), cells_with_some,
             hops * hop_share * reach[static_cast<std::size_t>(leaf)]))
      needs.emplace_back(leaf, rank);
  };
  const std::vector<char> cells_with_own = cells_with_some_of(rank_);
  for (std::int32_t leaf = 0; leaf < tree_->leaf_count(); ++leaf)
    if (hops_to(leaf) <= hops) add(leaf, rank_, cells_with_own);
  // A leaf between this rank and another one matters only if a path of the other's ghosts to the
  // leaves around the own ones can pass through it.
  HopSearch<Dim> search(*links_, [&](std::int32_t leaf) { return hops_to(leaf) <= hops; });
  for (const auto& [rank, leaves] : of_others) {
    halo.neighbours_.push_back(rank);
    const std::vector<char> some = cells_with_some_of(rank);
    search.run(leaves, hops, [&, r = rank](std::int32_t leaf, int hop) {
      if (hops_to(leaf) <= 1) add(leaf, r, some);
      return hops_to(leaf) + hop <= hops + 1;
    });
  }
  std::sort(needs.begin(), needs.end());
  halo.offset_.assign(static_cast<std::size_t>(tree_->leaf_count()) + 1, 0);
  for (const auto& [leaf, rank] : needs) {
    ++halo.offset_[static_cast<std::size_t>(leaf) + 1];
    halo.ranks_.push_back(rank);
  }
  std::partial_sum(halo.offset_.begin(), halo.offset_.end(), halo.offset_.begin());
  find_interior(halo, from_own);
  return halos_.emplace(hops, std::move(halo)).first->second;
}

// A leaf that another rank holds or needs is not interior, nor are its neighbours.
template <int Dim>
void Distribution<Dim>::find_interior(Halo& halo, const std::vector<std::int32_t>& from_own) const {
  const auto leaves = static_cast<std::size_t>(tree_->leaf_count());
  std::vector<std::int32_t> exchanged;
  halo.interior_.assign(leaves, 0);
  for (std::size_t leaf = 0; leaf < leaves; ++leaf) {
    const int by = holder(static_cast<std::int32_t>(leaf));
    if (from_own[leaf] <= 2 && by >= 0 &&
        (by != rank_ || halo.offset_[leaf] < halo.offset_[leaf + 1]))
      exchanged.push_back(static_cast<std::int32_t>(leaf));
    else
      halo.interior_[leaf] = from_own[leaf] <= 1;
  }
  HopSearch<Dim>(*links_).run(exchanged, 1, [&](std::int32_t leaf, int) {
    halo.interior_[static_cast<std::size_t>(leaf)] = 0;
    return true;
  });
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
