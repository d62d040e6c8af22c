// SPDX-License-Identifier: BSD-3-Clause
// The adjustment of the bubble population (section 2.4 of the paper). Bubbles with too large an
// overlap ratio are deleted. Beside bubbles with too small a ratio new ones are inserted in the
// largest holes. A contest decides which candidates act: a candidate acts if its (defect, id) is
// the strict maximum within kContestHops hops of the adjacency lists. All candidates read the state
// before the event, so the outcome does not depend on any order. A rank computes the bids of the
// nodes it owns and receives the bids of its ghosts from their owners.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/nodes.hpp"
#include "neighbors/adjacency_list.hpp"
#include "population/population_thresholds.hpp"

namespace pnpbs {

// A bubble to be inserted.
template <int Dim>
struct Birth {
  Point<Dim> position;
  std::int64_t parent;  // id of the parent
  double d;             // spacing of the parent
  std::int32_t boundary_node = -1;
};

enum class Action : char { none, remove, insert };

// The bid of a node in the contest: the change it applies for, and the weight of its defect.
template <int Dim>
struct Bid {
  double defect = 0;
  std::int64_t id = -1;
  Point<Dim> place{};  // position of the insertion, or of the node to delete
  Action action = Action::none;

  bool beats(const Bid& other) const {
    return defect > other.defect || (defect == other.defect && id > other.id);
  }
  void translate(const Translation<Dim>& by, const BoundarySeenFrom<Dim>&) {
    id = by.id(id);
    place = by(place);
  }
};

// The changes that the owned winners of a contest make.
template <int Dim>
struct PopulationChange {
  std::vector<std::int32_t> deleted;  // indices of nodes
  std::vector<Birth<Dim>> born;       // in no particular order
  std::vector<std::int32_t> parents;  // parents[k]: index of the parent of born[k]
};

// Number of hops of the adjacency lists around a candidate within which nodes count for the room
// and the overlap ratio of a new bubble.
inline constexpr int kRoomHops = 2;

// Returns the owned nodes whose overlap ratio is small enough for an insertion beside them.
template <int Dim>
std::vector<std::int32_t> owned_beside_gaps(const Nodes<Dim>& nodes, const View<double>& ratios,
                                            const PopulationRule& rule,
                                            const PopulationThresholds& thresholds);

// Returns the bid of each node. Nodes that need no change, and ghosts, have Action::none.
// must_go(i) says whether node i has no room and is deleted whatever its ratio is. free_place(i)
// returns the position of a new bubble beside node i. fits(x, d) says whether the domain allows a
// bubble at x. The lists of the owned nodes, and those of the neighbours of owned_beside_gaps(),
// must be up to date with a radius of at least 1.5.
template <int Dim>
View<Bid<Dim>> bids_of_owned(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists,
                             const View<double>& ratios, const PopulationRule& rule,
                             const PopulationThresholds& thresholds,
                             const std::function<bool(std::int64_t)>& must_go,
                             const std::function<Point<Dim>(std::int64_t)>& free_place,
                             const std::function<bool(const Point<Dim>&, double)>& fits);

// Returns the owned nodes that bid.
template <int Dim>
std::vector<std::int32_t> own_bidders(const Nodes<Dim>& nodes, const View<Bid<Dim>>& bids);

// Returns the changes of the winners among `bidders`. The bids of ghosts must be known, and the
// lists of all nodes within two hops of the bidders must be up to date.
template <int Dim>
PopulationChange<Dim> outcome_of_contest(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists,
                                         const View<Bid<Dim>>& bids,
                                         const std::vector<std::int32_t>& bidders);

}  // namespace pnpbs
