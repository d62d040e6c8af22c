// SPDX-License-Identifier: BSD-3-Clause
// Adjusting the bubble population (section 2.4 of the paper): bubbles whose overlap ratio is too
// large go, and in the largest holes beside those whose ratio is too small new ones appear. Who
// acts is a contest: a candidate does so if its (defect, id) is the strict maximum within three
// hops of the adjacency lists. All read the state before the event, so the outcome has no order.
// Ranks bid for the nodes they own, and know the bids of ghosts from their owners.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/nodes.hpp"
#include "neighbors/adjacency_list.hpp"
#include "population/population_thresholds.hpp"

namespace pnpbs {

template <int Dim>
struct Birth {
  Point<Dim> position;
  std::int64_t parent;  // id
  double d;             // the parent's
  std::int32_t boundary_node = -1;
};

enum class Action : char { none, remove, insert };

// What a node brings to the contest.
template <int Dim>
struct Bid {
  double defect = 0;
  std::int64_t id = -1;
  Point<Dim> place{};  // where something goes or comes
  Action action = Action::none;

  bool beats(const Bid& other) const {
    return defect > other.defect || (defect == other.defect && id > other.id);
  }
};

template <int Dim>
struct PopulationChange {
  std::vector<std::int32_t> deleted;  // nodes
  std::vector<Birth<Dim>> born;       // in no particular order; ids follow from the place
  std::vector<std::int32_t> parents;  // of those born: nodes
};

// A new bubble is looked at with all that lie within so many hops of the lists.
inline constexpr int kRoomHops = 2;

// Owned nodes with so small a ratio that a new bubble may come beside them.
template <int Dim>
std::vector<std::int32_t> owned_beside_gaps(const Nodes<Dim>& nodes, const View<double>& ratios,
                                            const PopulationRule& rule,
                                            const PopulationThresholds& thresholds);

// The bids of owned nodes, by node; Action::none of those that are content, and of ghosts.
// must_go(i): node i has no room and goes whatever its ratio. free_place(i): where a new bubble
// would come beside node i. fits(x, d): is a new bubble allowed at x by the domain? Lists must be
// fresh, with a radius of at least 1.5: those of owned nodes, and of neighbours of such beside
// gaps.
template <int Dim>
View<Bid<Dim>> bids_of_owned(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists,
                             const View<double>& ratios, const PopulationRule& rule,
                             const PopulationThresholds& thresholds,
                             const std::function<bool(std::int64_t)>& must_go,
                             const std::function<Point<Dim>(std::int64_t)>& free_place,
                             const std::function<bool(const Point<Dim>&, double)>& fits);

// The owned nodes that bid.
template <int Dim>
std::vector<std::int32_t> own_bidders(const Nodes<Dim>& nodes, const View<Bid<Dim>>& bids);

// What the winners among these do, where the bids of ghosts are known, and lists within two rings
// around the bidders.
template <int Dim>
PopulationChange<Dim> outcome_of_contest(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists,
                                         const View<Bid<Dim>>& bids,
                                         const std::vector<std::int32_t>& bidders);

}  // namespace pnpbs
