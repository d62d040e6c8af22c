// SPDX-License-Identifier: BSD-3-Clause
// What the check of the results asks of nodes and adjacency lists, in the plane and in space; and
// what it needs to ask more.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/point_text.hpp"
#include "results/results.hpp"

namespace pnpbs {

// Throws Error(ErrorKind::internal).
[[noreturn]] void fail_check(const MessageText& what);

// Of what is handed out. Its checks are collective, and fail on any rank that finds something.
template <int Dim>
class NodeCheck {
 public:
  explicit NodeCheck(const Results<Dim>& results)
      : p_(results),
        comm_(results.communicator()),
        level_(results.level()),
        nodes_(level_.nodes),
        owned_(results.count()) {}

  // Ids are unique.
  void check_ids() const;
  // No two nodes lie in one place.
  void check_places() const;
  // Node i is in the list of node j where j is in that of i.
  void check_lists() const;

  const Level<Dim>& level() const { return level_; }
  MessageText name(std::int64_t i) const {
    return std::to_string(nodes_.id(i)) + " " + point_text(position(i));
  }
  // The owned node with this id, or -1.
  std::int64_t owned_node(std::int64_t id) const;
  int owner_of(std::int64_t i) const { return level_.tree->owner_at(position(i)); }

 protected:
  struct PlacedId {
    std::int64_t id;
    Point<Dim> x;
  };
  // Two numbers of a node of another rank's, to look for there.
  struct ListedPair {
    std::int64_t of, listed;  // ids: the list of `of` must have `listed`
    std::int32_t owner;       // of `of`
  };

  Point<Dim> position(std::int64_t i) const { return nodes_.position(i); }
  template <class Visit>
  void for_owned(const Visit& visit) const {
    for (std::int64_t place = 0; place < owned_; ++place) visit(p_.node_at(place));
  }

  void check_inside(std::int64_t i, const FacetIndex<Dim>& boundary) const;
  // Node i, which was laid on the boundary, is still there.
  void check_laid(std::int64_t i, const Point<Dim>& laid) const;
  // Of the nodes that were laid there, each comes once, but for as many as were left out and
  // those that may_lack(k): times is how often on this rank, and where(k) where it was laid.
  // Collective.
  template <class Where, class MayLack>
  void check_laid_come_once(std::vector<std::int64_t> times, const Where& where,
                            const MayLack& may_lack) const {
    comm_.allreduce_sum(times);
    std::int64_t left_out = level_.left_out;
    for (std::size_t k = 0; k < times.size(); ++k)
      if (times[k] != 1 && !(times[k] == 0 && (may_lack(k) || left_out-- > 0)))
        fail_check("the boundary's node " + point_text(where(k)) + " comes " +
                   std::to_string(times[k]) + " times");
  }
  // Of all ranks, in parts of 2^-40 of the unit: a sum with no order. Collective.
  double sum_over_ranks(double mine, double unit) const;

  const Results<Dim>& p_;
  const Communicator& comm_;
  const Level<Dim>& level_;
  const Nodes<Dim>& nodes_;
  std::int64_t owned_;

 private:
  static MessageText text_of(const PlacedId& node) {
    return std::to_string(node.id) + " " + point_text(node.x);
  }
  std::vector<PlacedId> gathered_by(std::uint64_t (*key)(const PlacedId&)) const;
  bool lists(std::int64_t i, std::int64_t id) const;
};

extern template class NodeCheck<2>;
extern template class NodeCheck<3>;

}  // namespace pnpbs
