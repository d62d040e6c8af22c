// SPDX-License-Identifier: BSD-3-Clause
// The leaves of a background tree that is too large for one rank. Each rank has a contiguous range
// of the leaves in Morton order, and all ranks know where the ranges begin.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "comm/communicator.hpp"
#include "comm/rank_span.hpp"
#include "comm/records.hpp"
#include "tree/background_tree.hpp"

namespace pnpbs {

// Integer coordinates in units of the smallest possible cells.
template <int Dim>
using FineIndex = std::array<std::uint32_t, Dim>;

// Returns true if a precedes b in Morton order. The coordinates that differ in the highest bit
// decide, and among these the last one.
template <std::size_t Dim>
bool morton_before(const std::array<std::uint32_t, Dim>& a,
                   const std::array<std::uint32_t, Dim>& b) {
  std::size_t decides = Dim - 1;
  std::uint32_t differing = 0;
  for (std::size_t k = Dim; k-- > 0;) {
    const std::uint32_t here = a[k] ^ b[k];
    if (differing < here && differing < (differing ^ here)) {
      decides = k;
      differing = here;
    }
  }
  return a[decides] < b[decides];
}

// A leaf, independent of any tree object.
template <int Dim>
struct LeafCell {
  std::array<std::uint32_t, Dim> index{};  // integer coordinates among the cells of its depth
  std::int32_t depth = 0;

  std::uint32_t fine_side() const { return 1u << (BackgroundTree<Dim>::kMaxDepth - depth); }
  // Returns the first fine cell of the leaf in Morton order.
  FineIndex<Dim> first() const {
    FineIndex<Dim> corner = index;
    for (std::uint32_t& i : corner) i *= fine_side();
    return corner;
  }
  // Returns the last fine cell of the leaf in Morton order.
  FineIndex<Dim> last() const {
    FineIndex<Dim> corner = first();
    for (std::uint32_t& i : corner) i += fine_side() - 1;
    return corner;
  }
  bool holds(const FineIndex<Dim>& fine) const {
    for (int k = 0; k < Dim; ++k)
      if (fine[k] / fine_side() != index[k]) return false;
    return true;
  }
  LeafCell child(int number) const {
    LeafCell cell{index, depth + 1};
    for (int k = 0; k < Dim; ++k) cell.index[k] = 2 * index[k] + ((number >> k) & 1);
    return cell;
  }
};

// Returns true if the two closed cells have a common point.
template <int Dim>
bool touching(const LeafCell<Dim>& a, const LeafCell<Dim>& b) {
  const FineIndex<Dim> first_a = a.first(), first_b = b.first();
  for (int k = 0; k < Dim; ++k)
    if (first_a[k] > first_b[k] + b.fine_side() || first_b[k] > first_a[k] + a.fine_side())
      return false;
  return true;
}

// Maps each cell to the ranks that have its leaves.
template <int Dim>
class LeafRanges {
 public:
  LeafRanges() = default;
  // Collects the ranges of all ranks. `own` has the leaves of this rank in Morton order and may be
  // empty. Collective.
  LeafRanges(const Communicator& comm, const std::vector<LeafCell<Dim>>& own) {
    Bytes mine;
    if (!own.empty()) pack(mine, Begin{own.front().first(), comm.rank()});
    for_records<Begin>(comm.allgather(mine),
                       [this](const Begin& begin) { begins_.push_back(begin); });
  }

  // Returns the rank that has the leaf with this fine cell.
  std::int32_t rank_with(const FineIndex<Dim>& fine) const {
    return begins_[static_cast<std::size_t>(stretch_with(fine))].rank;
  }

  // Calls visit(rank) for all ranks that have leaves in the cell, or for the rank with the leaf
  // that contains the cell.
  template <class Visit>
  void for_ranks_in(const LeafCell<Dim>& cell, const Visit& visit) const {
    const std::int64_t last = stretch_with(cell.last());
    for (std::int64_t s = stretch_with(cell.first()); s <= last; ++s)
      visit(begins_[static_cast<std::size_t>(s)].rank);
  }

 private:
  struct Begin {
    FineIndex<Dim> first;
    std::int32_t rank;
  };

  std::int64_t stretch_with(const FineIndex<Dim>& fine) const {
    const auto next = std::upper_bound(
        begins_.begin(), begins_.end(), fine,
        [](const FineIndex<Dim>& x, const Begin& begin) { return morton_before(x, begin.first); });
    return next - begins_.begin() - 1;
  }

  std::vector<Begin> begins_;  // of the ranks with leaves, in Morton order
};

// Redistributes the records so that all ranks have equal numbers of them. The global order of the
// records, by rank and index, is preserved. Collective.
template <class Record>
void spread_evenly(const Communicator& comm, std::vector<Record>& records) {
  if (comm.size() == 1) return;
  const RankSpan span = span_of(comm, records.size());
  const Record* first = records.data();
  records = redistribute<Record>(comm, records, [&](const Record& record) {
    const std::int64_t number = span.first + (&record - first);
    return static_cast<int>(number * comm.size() / span.total);
  });
}

}  // namespace pnpbs
