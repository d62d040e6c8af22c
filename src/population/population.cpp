// SPDX-License-Identifier: BSD-3-Clause
#include "population/population.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "method/constants.hpp"
#include "neighbors/rings.hpp"
#include "population/population_thresholds.hpp"

namespace pnpbs {

namespace {

// The distance up to which two candidates are rivals, in spacings. In the plane all candidates
// within kContestHops hops are rivals. In space as many hops contain 600 nodes, of which only one
// could act per event while dozens are missing. Rivals in space are therefore only those whose
// changes affect each other's overlap ratio.
template <int Dim>
constexpr double kReach{Dim == 2 ? std::numeric_limits<double>::infinity()
                                 : method::kContestReachInSpace};

// Returns whether a bubble at `place` keeps the required distance from node i, its neighbours and
// theirs. Boundary nodes do not move away, so the distance from them is always at least min_gap.
template <int Dim>
bool has_room(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists, std::int64_t i,
              const Point<Dim>& place, double gap, const PopulationRule& rule) {
  const auto leaves_room = [&](std::int64_t j, int) {
    const double desired = 0.5 * (nodes.d(i) + nodes.d(j));
    const double needed = nodes.moves(j) ? gap : rule.min_gap;
    return distance<Dim>(nodes.position(j), place) >= needed * desired;
  };
  return leaves_room(i, 0) && for_rings(lists, i, kRoomHops, leaves_room);
}

// Returns the overlap ratio that a bubble with the spacing of node i has at `place`. Only node i,
// its neighbours and theirs contribute.
template <int Dim>
double overlap_ratio_at(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists, std::int64_t i,
                        const Point<Dim>& place) {
  // sorted by id, which fixes the order of the sum
  std::vector<std::pair<std::int64_t, double>> overlaps;
  const auto add = [&](std::int64_t j, int) {
    const double gap = distance<Dim>(nodes.position(j), place);
    overlaps.emplace_back(nodes.id(j), overlap(nodes.d(i), nodes.d(j), gap));
    return true;
  };
  add(i, 0);
  for_rings(lists, i, kRoomHops, add);
  std::sort(overlaps.begin(), overlaps.end());
  double sum = 0;
  for (const auto& [id, term] : overlaps) sum += std::max(0.0, term);
  return sum / (0.5 * nodes.d(i));
}

// Returns whether node i wins the contest: no rival has a larger bid.
template <int Dim>
bool wins(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists, const View<Bid<Dim>>& bids,
          std::int64_t i) {
  const Bid<Dim>& own = bids(i);
  return for_rings(lists, i, method::kContestHops, [&](std::int64_t j, int) {
    const Bid<Dim>& rival = bids(j);
    return !rival.beats(own) || distance<Dim>(own.place, rival.place) > kReach<Dim> * nodes.d(i);
  });
}

// Returns the overlap ratio below which a node bids for an insertion.
double least_ratio(const PopulationRule& rule, const PopulationThresholds::Pair& threshold) {
  return std::max(rule.insert_below, threshold.insert_below);
}

}  // namespace

template <int Dim>
std::vector<std::int32_t> owned_beside_gaps(const Nodes<Dim>& nodes, const View<double>& ratios,
                                            const PopulationRule& rule,
                                            const PopulationThresholds& thresholds) {
  std::vector<std::int32_t> found;
  for (std::int32_t i = 0; i < nodes.count; ++i)
    if (nodes.moves(i) && nodes.owned(i) &&
        ratios(i) < least_ratio(rule, thresholds.at(nodes.d(i))))
      found.push_back(i);
  return found;
}

template <int Dim>
View<Bid<Dim>> bids_of_owned(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists,
                             const View<double>& ratios, const PopulationRule& rule,
                             const PopulationThresholds& thresholds,
                             const std::function<bool(std::int64_t)>& must_go,
                             const std::function<Point<Dim>(std::int64_t)>& free_place,
                             const std::function<bool(const Point<Dim>&, double)>& fits) {
  const View<Bid<Dim>> bids = make_view<Bid<Dim>>("pnpbs::population::bids", nodes.count);
  for_each("pnpbs::population::bid", nodes.count, [&](std::int64_t i) {
    Bid<Dim> bid{0, nodes.id(i), nodes.position(i), Action::none};
    if (nodes.moves(i) && nodes.owned(i)) {
      const double ratio = ratios(i);
      const PopulationThresholds::Pair& threshold = thresholds.at(nodes.d(i));
      if (must_go(i)) {
        bid.defect = std::numeric_limits<double>::max();
        bid.action = Action::remove;
      } else if (ratio > threshold.delete_above) {
        bid.defect = ratio - rule.ideal;
        bid.action = Action::remove;
      } else if (ratio < least_ratio(rule, threshold)) {
        const double gap = ratio < threshold.insert_below ? rule.min_gap_to_aim : rule.min_gap;
        const Point<Dim> place = free_place(i);
        // A bubble between boundary nodes that are dense for d may have too large a ratio. It is
        // not inserted, because the next event deletes it and the one after inserts it again.
        if (has_room<Dim>(nodes, lists, i, place, gap, rule) && fits(place, nodes.d(i)) &&
            overlap_ratio_at<Dim>(nodes, lists, i, place) <= rule.delete_above)
          bid = {rule.ideal - ratio, nodes.id(i), place, Action::insert};
      }
    }
    bids(i) = bid;
  });
  return bids;
}

template <int Dim>
std::vector<std::int32_t> own_bidders(const Nodes<Dim>& nodes, const View<Bid<Dim>>& bids) {
  std::vector<std::int32_t> bidders;
  for (std::int32_t i = 0; i < nodes.count; ++i)
    if (nodes.owned(i) && bids(i).action != Action::none) bidders.push_back(i);
  return bidders;
}

template <int Dim>
PopulationChange<Dim> outcome_of_contest(const Nodes<Dim>& nodes, const AdjacencyList<Dim>& lists,
                                         const View<Bid<Dim>>& bids,
                                         const std::vector<std::int32_t>& bidders) {
  std::vector<char> winner(bidders.size());
  for_each("pnpbs::population::contest", static_cast<std::int64_t>(bidders.size()),
           [&](std::int64_t b) {
             const auto k = static_cast<std::size_t>(b);
             winner[k] = wins<Dim>(nodes, lists, bids, bidders[k]);
           });
  PopulationChange<Dim> change;
  for (std::size_t b = 0; b < bidders.size(); ++b) {
    if (winner[b] == 0) continue;
    const std::int32_t i = bidders[b];
    if (bids(i).action == Action::remove) {
      change.deleted.push_back(i);
    } else {
      change.born.push_back({bids(i).place, nodes.id(i), nodes.d(i)});
      change.parents.push_back(i);
    }
  }
  return change;
}

template std::vector<std::int32_t> owned_beside_gaps<2>(const Nodes<2>&, const View<double>&,
                                                        const PopulationRule&,
                                                        const PopulationThresholds&);
template std::vector<std::int32_t> owned_beside_gaps<3>(const Nodes<3>&, const View<double>&,
                                                        const PopulationRule&,
                                                        const PopulationThresholds&);
template View<Bid<2>> bids_of_owned<2>(const Nodes<2>&, const AdjacencyList<2>&,
                                       const View<double>&, const PopulationRule&,
                                       const PopulationThresholds&,
                                       const std::function<bool(std::int64_t)>&,
                                       const std::function<Point<2>(std::int64_t)>&,
                                       const std::function<bool(const Point<2>&, double)>&);
template View<Bid<3>> bids_of_owned<3>(const Nodes<3>&, const AdjacencyList<3>&,
                                       const View<double>&, const PopulationRule&,
                                       const PopulationThresholds&,
                                       const std::function<bool(std::int64_t)>&,
                                       const std::function<Point<3>(std::int64_t)>&,
                                       const std::function<bool(const Point<3>&, double)>&);
template std::vector<std::int32_t> own_bidders<2>(const Nodes<2>&, const View<Bid<2>>&);
template std::vector<std::int32_t> own_bidders<3>(const Nodes<3>&, const View<Bid<3>>&);
template PopulationChange<2> outcome_of_contest<2>(const Nodes<2>&, const AdjacencyList<2>&,
                                                   const View<Bid<2>>&,
                                                   const std::vector<std::int32_t>&);
template PopulationChange<3> outcome_of_contest<3>(const Nodes<3>&, const AdjacencyList<3>&,
                                                   const View<Bid<3>>&,
                                                   const std::vector<std::int32_t>&);

}  // namespace pnpbs
