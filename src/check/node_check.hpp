// SPDX-License-Identifier: BSD-3-Clause
// Checks of nodes and adjacency lists that the plane and space have in common, and helpers of
// further checks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/point_text.hpp"
#include "results/results.hpp"

namespace pnpbs {

// Throws Error(ErrorKind::internal) with a message that the check failed.
[[noreturn]] void fail_check(const MessageText& what);

// Checks of the returned results. They are collective and throw on each rank that finds a fault.
template <int Dim>
class NodeCheck {
 public:
  explicit NodeCheck(const Results<Dim>& results)
      : p_(results),
        comm_(results.communicator()),
        level_(results.level()),
        nodes_(level_.nodes),
        owned_(results.count()) {}

  // Checks that ids are unique and not negative.
  void check_ids() const;
  // Checks that positions are finite and that no two nodes coincide.
  void check_places() const;
  // Checks that the lists are sorted by id and symmetric.
  void check_lists() const;

  const Level<Dim>& level() const { return level_; }
  MessageText name(std::int64_t i) const {
    return std::to_string(nodes_.id(i)) + " " + point_text(position(i));
  }
  // Returns the index of the owned node with this id, or -1.
  std::int64_t owned_node(std::int64_t id) const;
  int owner_of(std::int64_t i) const { return level_.tree->owner_at(position(i)); }

 protected:
  struct PlacedId {
    std::int64_t id;
    Point<Dim> x;
  };
  // A pair of a list to be checked on the rank that owns the first node.
  struct ListedPair {
    std::int64_t of, listed;  // ids: the list of `of` must have `listed`
    std::int32_t owner;       // rank that owns `of`
  };

  ListedPair pair_at_owner(std::int64_t i, std::int64_t j) const;
  Point<Dim> position(std::int64_t i) const { return nodes_.position(i); }
  template <class Visit>
  void for_owned(const Visit& visit) const {
    for (std::int64_t place = 0; place < owned_; ++place) visit(p_.node_at(place));
  }

  // Checks that node i lies inside.
  void check_inside(std::int64_t i, const FacetIndex<Dim>& boundary) const;
  // Checks that node i is still at the point `laid` of the boundary where it was placed.
  void check_placed(std::int64_t i, const Point<Dim>& laid) const;
  // Checks that each node k placed on the boundary occurs once. It may be missing if may_lack(k) is
  // true; of the others, as many may be missing as the level has left out. times[k] is the number
  // of occurrences on this rank, and where(k) is the position. Collective.
  template <class Where, class MayLack>
  void check_placed_once(std::vector<std::int64_t> times, const Where& where,
                         const MayLack& may_lack) const {
    comm_.allreduce_sum(times);
    std::int64_t left_out = level_.left_out;
    for (std::size_t k = 0; k < times.size(); ++k)
      if (times[k] != 1 && !(times[k] == 0 && (may_lack(k) || left_out-- > 0)))
        fail_check("the boundary's node " + point_text(where(k)) + " occurs " +
                   std::to_string(times[k]) + " times");
  }
  // Returns the sum over all ranks, in multiples of 2^-40 `unit`, so that it does not depend on the
  // order. Collective.
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
