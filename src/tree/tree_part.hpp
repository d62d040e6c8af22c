// SPDX-License-Identifier: BSD-3-Clause
// One rank's part of a background tree that is distributed over ranks (leaf_cells.hpp): its own
// leaves, copies of the leaves of other ranks that touch them, and the adjacency of all these
// leaves.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "base/chunked_rows.hpp"
#include "comm/exchange_pattern.hpp"
#include "comm/records.hpp"
#include "tree/leaf_cells.hpp"

namespace pnpbs {

// Own leaves and copied leaves of a rank, numbered in this order.
template <int Dim>
class TreePart {
 public:
  TreePart() = default;
  // Builds the part. `own` has the leaves of this rank in Morton order. Leaves whose `live` is 0
  // are adjacent to no other leaf. Collective.
  TreePart(const Communicator& comm, const Box<Dim>& bounds, std::vector<LeafCell<Dim>> own,
           std::vector<char> live)
      : stretches_(comm, own), own_(std::ssize(own)), cells_(std::move(own)) {
    exchange_borders(comm, live);
    live.resize(cells_.size(), 1);
    grow_tree(bounds);
    link(live);
  }

  // Own leaves have the indices 0 .. own_count()-1, and copies the following ones.
  std::int64_t own_count() const { return own_; }
  std::int64_t count() const { return std::ssize(cells_); }

  // Returns the leaf that contains x, or -1 if this rank has neither the leaf nor a copy.
  std::int64_t leaf_at(const Point<Dim>& x) const {
    return number_[static_cast<std::size_t>(tree_.leaf_at(x))];
  }
  bool owns(std::int64_t leaf) const { return leaf >= 0 && leaf < own_; }
  std::int32_t rank_with(const Point<Dim>& x) const {
    return stretches_.rank_with(tree_.fine_index(x));
  }

  // Returns the adjacent leaves: all of them for an own leaf, only own leaves for a copy.
  std::span<const std::int32_t> touching_leaves(std::int64_t leaf) const {
    return touching_.row(leaf);
  }

  // Returns the exchange plan that copies values of own leaves to their copies, for fill_ghosts.
  const ExchangePattern& border() const { return border_; }

 private:
  struct Range {
    std::int64_t begin, end;
  };

  // Sends a copy of each own leaf to all ranks that have leaves in the cells of the same size
  // around it. Collective.
  void exchange_borders(const Communicator& comm, const std::vector<char>& live) {
    if (comm.size() == 1) return;
    std::map<std::int32_t, std::vector<std::int64_t>> sent;  // by rank
    for (std::int64_t leaf = 0; leaf < own_; ++leaf) {
      if (!live[static_cast<std::size_t>(leaf)]) continue;
      for_ranks_around(cells_[static_cast<std::size_t>(leaf)], [&](std::int32_t rank) {
        if (rank == comm.rank()) return;
        std::vector<std::int64_t>& row = sent[rank];
        if (row.empty() || row.back() != leaf) row.push_back(leaf);
      });
    }
    Outbox outgoing;
    for (const auto& [rank, leaves] : sent)
      for (const std::int64_t leaf : leaves)
        pack(outgoing.to(rank), cells_[static_cast<std::size_t>(leaf)]);
    std::map<std::int32_t, std::int64_t> received;
    for (const Message& message : comm.sparse_all_to_all(outgoing.messages()))
      for_records<LeafCell<Dim>>(message.bytes, [&](const LeafCell<Dim>& cell) {
        cells_.push_back(cell);
        ++received[message.rank];
        before_ += message.rank < comm.rank();
      });
    keep_pattern(std::move(sent), std::move(received));
  }

  void keep_pattern(std::map<std::int32_t, std::vector<std::int64_t>> sent,
                    std::map<std::int32_t, std::int64_t> received) {
    for (const auto& [rank, count] : received) sent[rank];  // some ranks only send copies
    border_.send_offsets.assign(1, 0);
    border_.receive_offsets.assign(1, 0);
    std::int64_t next = own_;
    for (const auto& [rank, leaves] : sent) {
      border_.ranks.push_back(rank);
      border_.send_nodes.insert(border_.send_nodes.end(), leaves.begin(), leaves.end());
      for (std::int64_t k = received[rank]; k > 0; --k) border_.receive_nodes.push_back(next++);
      border_.send_offsets.push_back(std::ssize(border_.send_nodes));
      border_.receive_offsets.push_back(std::ssize(border_.receive_nodes));
    }
  }

  // Calls visit(rank) for all ranks with leaves in the cell and in the cells of the same size
  // around it.
  template <class Visit>
  void for_ranks_around(const LeafCell<Dim>& cell, const Visit& visit) const {
    constexpr int kAround = Dim == 2 ? 9 : 27;
    const std::uint32_t cells = 1u << cell.depth;
    for (int around = 0; around < kAround; ++around) {
      LeafCell<Dim> other = cell;
      bool there = true;
      for (int k = 0, code = around; k < Dim; ++k, code /= 3) {
        other.index[k] += static_cast<std::uint32_t>(code % 3) - 1u;  // wraps below 0
        there = there && other.index[k] < cells;
      }
      if (there) stretches_.for_ranks_in(other, visit);
    }
  }

  // Returns the leaf with this index in Morton order. Copies are sorted by rank and each rank has
  // one range, so the copies from lower ranks precede the own leaves.
  std::int64_t leaf_in_order(std::int64_t place) const {
    if (place < before_) return own_ + place;
    return place < before_ + own_ ? place - before_ : place;
  }
  const LeafCell<Dim>& cell_in_order(std::int64_t place) const {
    return cells_[static_cast<std::size_t>(leaf_in_order(place))];
  }

  // Builds a local tree with the leaves of this part. Its other cells are left coarse.
  void grow_tree(const Box<Dim>& bounds) {
    std::vector<Range> ranges{{0, count()}};  // leaves of this part in each cell
    std::int32_t parents = 0;                 // index of the first cell of the depth above
    tree_.build(bounds, [&](const BackgroundTree<Dim>& tree, std::int32_t first, std::int32_t last,
                            std::vector<char>& split) {
      add_ranges(tree, parents, first, ranges);
      parents = first;
      for (std::int32_t c = first; c < last; ++c) {
        const Range range = ranges[static_cast<std::size_t>(c)];
        split[static_cast<std::size_t>(c - first)] =
            range.begin < range.end && cell_in_order(range.begin).depth > tree.cell(c).depth;
      }
    });
    add_ranges(tree_, parents, tree_.cell_count(), ranges);
    leaf_.resize(cells_.size());
    for (std::int32_t leaf = 0; leaf < tree_.leaf_count(); ++leaf) {
      const Range range = ranges[static_cast<std::size_t>(tree_.leaf_cell(leaf))];
      const std::int64_t here = range.begin < range.end ? leaf_in_order(range.begin) : -1;
      number_.push_back(static_cast<std::int32_t>(here));
      if (here >= 0) leaf_[static_cast<std::size_t>(here)] = leaf;
    }
  }

  // Appends the ranges of the children of the cells first .. last-1.
  void add_ranges(const BackgroundTree<Dim>& tree, std::int32_t first, std::int32_t last,
                  std::vector<Range>& ranges) const {
    for (std::int32_t c = first; c < last; ++c) {
      if (tree.cell(c).first_child < 0) continue;
      if (std::ssize(ranges) > tree.cell(c).first_child) continue;
      Range rest = ranges[static_cast<std::size_t>(c)];
      for (int k = 0; k < BackgroundTree<Dim>::kChildren; ++k) {
        const auto& child = tree.cell(tree.cell(c).first_child + k);
        const FineIndex<Dim> last_in_child = LeafCell<Dim>{child.index, child.depth}.last();
        const std::int64_t begin = rest.begin;
        for (std::int64_t count = rest.end - begin; count > 0;) {
          const std::int64_t half = count / 2, middle = rest.begin + half;
          if (morton_before(last_in_child, cell_in_order(middle).first())) {
            count = half;
          } else {
            rest.begin = middle + 1;
            count -= half + 1;
          }
        }
        ranges.push_back({begin, rest.begin});
      }
    }
  }

  void link(const std::vector<char>& live) {
    touching_.build("pnpbs::TreePart::link", count(), [&] {
      return [&](std::int64_t leaf, std::vector<std::int32_t>& row) {
        if (!live[static_cast<std::size_t>(leaf)]) return;
        const std::int32_t cell = tree_.leaf_cell(leaf_[static_cast<std::size_t>(leaf)]);
        tree_.for_leaves_in(tree_.cell_box(cell), [&](std::int32_t found) {
          const std::int32_t other = number_[static_cast<std::size_t>(found)];
          if (other < 0 || other == leaf || !live[static_cast<std::size_t>(other)]) return;
          if (leaf >= own_ && other >= own_) return;
          if (touching(cells_[static_cast<std::size_t>(leaf)],
                       cells_[static_cast<std::size_t>(other)]))
            row.push_back(other);
        });
      };
    });
  }

  LeafRanges<Dim> stretches_;
  std::int64_t own_ = 0, before_ = 0;  // before_: number of copies from lower ranks
  std::vector<LeafCell<Dim>> cells_;
  ExchangePattern border_;
  BackgroundTree<Dim> tree_;
  std::vector<std::int32_t> number_;  // by leaf of tree_: leaf of this part, or -1
  std::vector<std::int32_t> leaf_;    // by leaf of this part: leaf of tree_
  ChunkedRows<std::int32_t> touching_;
};

}  // namespace pnpbs
