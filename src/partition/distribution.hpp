// SPDX-License-Identifier: BSD-3-Clause
// Who owns which part of the background tree, and who needs its nodes as ghosts. The cells of the
// partition are known everywhere; the leaves in them, the graph of their interactions and the
// halos only as far as this rank's nodes and ghosts can be.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "comm/communicator.hpp"
#include "partition/partition_cells.hpp"
#include "tree/leaf_graph.hpp"

namespace pnpbs {

// The ghost layers for one depth, in hops of the leaf graph.
class Halo {
 public:
  // Other ranks that hold something within the depth of a leaf of ours, or of one near ours.
  template <class Visit>
  void for_ranks(std::int32_t leaf, const Visit& visit) const {
    for (std::int32_t k = offset_[static_cast<std::size_t>(leaf)];
         k < offset_[static_cast<std::size_t>(leaf) + 1]; ++k)
      visit(ranks_[static_cast<std::size_t>(k)]);
  }
  // Are the leaf and those it interacts with ours, or empty, and needed by no other rank? Then its
  // nodes have nothing to do with an exchange, wherever they drift.
  bool interior(std::int32_t leaf) const { return interior_[static_cast<std::size_t>(leaf)] != 0; }
  // Ranks to exchange messages with. Symmetric: who is our neighbour has us as one. One hop more
  // than the depth, because nodes drift out of their leaves between exchanges.
  const std::vector<int>& neighbours() const { return neighbours_; }

 private:
  template <int Dim>
  friend class Distribution;
  std::vector<std::int32_t> offset_, ranks_;  // the owner is not among them
  std::vector<char> interior_;
  std::vector<int> neighbours_;
};

template <int Dim>
class Distribution {
 public:
  Distribution() = default;  // one rank, which owns all
  Distribution(PartitionCells<Dim> cells, std::vector<std::int32_t> owner, int rank)
      : cells_(std::move(cells)), owner_(std::move(owner)), rank_(rank) {}

  // The same cells and owners, for another tree.
  Distribution without_leaves() const { return Distribution(cells_, owner_, rank_); }

  const PartitionCells<Dim>& cells() const { return cells_; }
  int owner_of_cell(std::int32_t cell) const { return owner_[static_cast<std::size_t>(cell)]; }
  int owner_at(const Point<Dim>& x) const { return owner_of_cell(cells_.at(x)); }
  // Has it nothing of the domain? Such cells are anybody's, and nobody needs them.
  bool empty(std::int32_t cell) const { return cells_.max_spacing(cell) == 0; }
  // Calls visit(rank) for the owner of each cell that the box touches and that is not empty, once
  // for every cell.
  template <class Visit>
  void for_owners_in(const Box<Dim>& box, const Visit& visit) const {
    cells_.tree().for_leaves_in(box, [&](std::int32_t cell) {
      if (!empty(cell)) visit(owner_of_cell(cell));
    });
  }
  // Cells that may hold ghosts: those within some hops of a bubble of ours, by the largest d.
  std::vector<char> cells_near_own(int hops, double reach) const;

  // --- once the tree is refined in the cells marked ---
  void take_leaves(const BackgroundTree<Dim>* tree, const std::vector<char>& refined);
  void link_leaves(std::shared_ptr<const LeafLinks<Dim>> links) { links_ = std::move(links); }
  bool cell_refined(std::int32_t cell) const {
    return refined_[static_cast<std::size_t>(cell)] != 0;
  }
  bool refined(std::int32_t leaf) const { return cell_refined(cell_of(leaf)); }
  std::int32_t cell_of(std::int32_t leaf) const {
    return cell_of_leaf_[static_cast<std::size_t>(leaf)];
  }
  bool owns(std::int32_t leaf) const { return owner_.empty() || owner(leaf) == rank_; }
  int owner(std::int32_t leaf) const { return owner_of_cell(cell_of(leaf)); }
  // Rank that has the nodes in the leaf; -1 if there can be none.
  int holder(std::int32_t leaf) const { return empty(cell_of(leaf)) ? -1 : owner(leaf); }
  bool holds(std::int32_t leaf) const { return holder(leaf) == rank_; }
  // Marks the leaves within so many hops of those we hold.
  std::vector<char> leaves_within(int hops) const;
  // Cells with such leaves that are not refined.
  std::vector<std::int32_t> unrefined_within(int hops) const;
  // Made on first use and kept. A hop ends at the far side of a leaf, but what comes over it comes
  // from no farther than `hop_share` of the reach of the largest bubbles about: what lies beyond
  // all hops together is not needed.
  const Halo& halo(int hops, double hop_share);

  // For one count per leaf, on every rank those of its own nodes: the sum over all leaves before
  // each one in Morton order, of all ranks, from `start` on; moves `start` on by the sum over all.
  // 0 for leaves in cells that are another's and in which nothing is counted here. What is numbered
  // so does not depend on who owns which leaf. Sums are modulo 2^64. Collective.
  std::vector<std::int64_t> prefix_sums(const Communicator& comm, std::vector<std::int64_t> counts,
                                        std::int64_t& start) const;

 private:
  PartitionCells<Dim> cells_;
  std::vector<std::int32_t> owner_;  // of the cells; empty: one rank
  int rank_ = 0;

  const BackgroundTree<Dim>* tree_ = nullptr;
  std::shared_ptr<const LeafLinks<Dim>> links_;  // leaves that interact
  std::vector<std::int32_t> cell_of_leaf_;
  std::vector<char> refined_;  // cells
  std::map<int, Halo> halos_;

  std::vector<double> reach_within(int hops, std::vector<std::int32_t> leaves) const;
  std::vector<char> cells_with_some_of(int rank) const;
  bool near(const Box<Dim>& box, const std::vector<char>& some, double way) const;
};

extern template class Distribution<2>;
extern template class Distribution<3>;

}  // namespace pnpbs
