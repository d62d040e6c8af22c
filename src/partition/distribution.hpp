// SPDX-License-Identifier: BSD-3-Clause
// Distribution of the background tree over the ranks, and the ghost layers that follow from it. All
// ranks have the cells of the partition. A rank has the leaves in them, the graph of the leaves and
// the halos only where its own nodes and ghosts can be.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "comm/communicator.hpp"
#include "partition/image_ranks.hpp"
#include "partition/partition_cells.hpp"
#include "tree/leaf_graph.hpp"

namespace pnpbs {

// Ghost layers of one depth, which is counted in hops of the leaf graph.
class Halo {
 public:
  // Calls visit(rank) for each rank besides the holder that needs the nodes of the leaf as ghosts,
  // because it holds a leaf within the depth. Valid for the leaves of this rank and those within a
  // hop of them. For leaves farther away only this rank is visited.
  template <class Visit>
  void for_ranks(std::int32_t leaf, const Visit& visit) const {
    for (std::int32_t k = offset_[static_cast<std::size_t>(leaf)];
         k < offset_[static_cast<std::size_t>(leaf) + 1]; ++k)
      visit(ranks_[static_cast<std::size_t>(k)]);
  }
  // Returns whether the leaf and all that interact with it are held by this rank or empty, and no
  // other rank needs them. Nodes of such a leaf take no part in an exchange, even if they drift
  // into a neighbour. False for leaves more than a hop away from those of this rank.
  bool interior(std::int32_t leaf) const { return interior_[static_cast<std::size_t>(leaf)] != 0; }
  // Ranks to exchange messages with. The relation is symmetric. It covers one hop more than the
  // depth, because nodes drift out of their leaves between exchanges.
  const std::vector<int>& neighbours() const { return neighbours_; }

 private:
  template <int Dim>
  friend class Distribution;
  std::vector<std::int32_t> offset_, ranks_;  // compressed rows by leaf, without the owner
  std::vector<char> interior_;
  std::vector<int> neighbours_;
};

// A distribution: the owner of each cell of the partition, and what follows from it for the leaves
// of the refined tree.
template <int Dim>
class Distribution {
 public:
  Distribution() = default;  // a single rank, which owns all cells
  // `owner` has the ranks of cells in the periodic cell, if there is one; those of images follow.
  Distribution(PartitionCells<Dim> cells, std::vector<std::int32_t> owner, int rank, int ranks);

  // Returns the same cells and owners without a refined tree.
  Distribution without_leaves() const;

  const PartitionCells<Dim>& cells() const { return cells_; }
  // Ranks have numbers of their own as the owners of images.
  const ImageRanks<Dim>& images() const { return images_; }
  int owner_of_cell(std::int32_t cell) const { return owner_[static_cast<std::size_t>(cell)]; }
  int owner_at(const Point<Dim>& x) const { return owner_of_cell(cells_.at(x)); }
  // Returns the imbalance of this work over the ranks.
  double imbalance_of(const std::vector<std::int64_t>& work) const;
  // Returns whether the cell lies outside the domain. No rank holds or needs the contents of
  // such a cell, even if it owns the cell.
  bool empty(std::int32_t cell) const { return cells_.max_spacing(cell) == 0; }
  // Calls visit(rank) for the owner of each cell that touches the box and is not empty. A rank is
  // visited once for each of its cells.
  template <class Visit>
  void for_owners_in(const Box<Dim>& box, const Visit& visit) const {
    cells_.tree().for_leaves_in(box, [&](std::int32_t cell) {
      if (!empty(cell)) visit(owner_of_cell(cell));
    });
  }
  // Marks the cells that can contain ghosts of this rank: those within `hops` hops of its cells,
  // estimated from the largest d of each cell. reach: of a bubble. [d]
  std::vector<char> cells_near_own(int hops, double reach) const;

  // --- valid once the tree is refined in the marked cells ---
  void take_leaves(const BackgroundTree<Dim>* tree, const std::vector<char>& refined);
  void link_leaves(std::shared_ptr<const LeafGraph<Dim>> links) { links_ = std::move(links); }
  bool cell_refined(std::int32_t cell) const {
    return refined_[static_cast<std::size_t>(cell)] != 0;
  }
  bool refined(std::int32_t leaf) const { return cell_refined(cell_of(leaf)); }
  std::int32_t cell_of(std::int32_t leaf) const {
    return cell_of_leaf_[static_cast<std::size_t>(leaf)];
  }
  bool owns(std::int32_t leaf) const { return owner_.empty() || owner(leaf) == rank_; }
  int owner(std::int32_t leaf) const { return owner_of_cell(cell_of(leaf)); }
  // Returns the rank that holds the nodes in the leaf, or -1 if the leaf is outside the domain.
  int holder(std::int32_t leaf) const { return empty(cell_of(leaf)) ? -1 : owner(leaf); }
  bool holds(std::int32_t leaf) const { return holder(leaf) == rank_; }
  // Returns for each leaf the number of hops to the nearest leaf that this rank holds, or
  // kUnreached if it is larger than `hops`.
  std::vector<std::int32_t> hops_from_own(int hops) const;
  // Returns the cells with leaves within `hops` hops in which the tree is not refined.
  std::vector<std::int32_t> unrefined_within(int hops) const;
  // Returns the halo of this depth, which is built on first use and kept. A hop ends at the far
  // side of a leaf. A node contributes from no farther than hops * hop_share times the reach of the
  // largest bubbles nearby, so leaves beyond that distance are left out.
  const Halo& halo(int hops, double hop_share);

  // Returns, for each leaf, the sum of `counts` over all leaves before it in Morton order and over
  // all ranks, plus `start`. Then adds the sum over all leaves to `start`. Each rank passes the
  // counts of its owned nodes. The result is 0 for leaves in cells of other ranks in which this
  // rank counts nothing. It does not depend on the partition. Sums are modulo 2^64. Collective.
  std::vector<std::int64_t> prefix_sums(const Communicator& comm, std::vector<std::int64_t> counts,
                                        std::int64_t& start) const;

 private:
  PartitionCells<Dim> cells_;
  ImageRanks<Dim> images_;
  std::vector<std::int32_t> owner_;  // of each cell; empty: a single rank
  int rank_ = 0, ranks_ = 1;

  const BackgroundTree<Dim>* tree_ = nullptr;
  std::shared_ptr<const LeafGraph<Dim>> links_;
  std::vector<std::int32_t> cell_of_leaf_;
  std::vector<char> refined_;  // by cell
  std::map<int, Halo> halos_;

  std::vector<double> reach_within(int hops, const std::vector<std::int32_t>& from_own,
                                   const std::vector<std::int32_t>& from_others) const;
  std::map<int, std::vector<std::int32_t>> near_leaves_of_others(
      int hops, const std::vector<std::int32_t>& from_own) const;
  void find_interior(Halo& halo, const std::vector<std::int32_t>& from_own) const;
  std::vector<char> cells_with_some_of(int rank) const;
  bool near(const Box<Dim>& box, const std::vector<char>& some, double way) const;
};

extern template class Distribution<2>;
extern template class Distribution<3>;

}  // namespace pnpbs
