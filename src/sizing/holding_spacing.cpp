// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/holding_spacing.hpp"

#include <algorithm>

#include "base/point_text.hpp"
#include "comm/records.hpp"
#include "level/node_spacing.hpp"
#include "method/constants.hpp"
#include "sizing/narrow_points.hpp"

namespace pnpbs {

namespace {

// Number of elements with small angles whose corners one rank can store.
constexpr std::int64_t kFewElements = 100000;

// Returns the points of all ranks, sorted and without duplicates. Collective.
template <int Dim>
std::vector<Point<Dim>> gathered(const Communicator& comm, const std::vector<Point<Dim>>& own) {
  std::vector<Point<Dim>> all = of_all_ranks(comm, own);
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

// Returns d at these points, which must be the same on all ranks. Collective.
template <int Dim>
std::vector<double> spacing_at(const Level<Dim>& level,
                               const std::vector<GrowthSource<Dim>>& places) {
  std::vector<double> d(places.size());
  collective_try(*level.comm, [&] {
    std::vector<Point<Dim>> x;
    for (const GrowthSource<Dim>& place : places) x.push_back(place.x);
    evaluate_spacing<Dim>(level.geometry.spacing(), measure_of(level.geometry.domain()),
                          std::ssize(x), x.data(), d.data());
  });
  return d;
}

// Returns points with the d that they require: half of d at unresolved points. Adds the narrow
// points of the surface near these if `with_narrow` is true, and those of the whole body if there
// are no unresolved points. Collective.
template <int Dim>
std::vector<GrowthSource<Dim>> places_to_hold(const Level<Dim>& level,
                                              const std::vector<Point<Dim>>& unresolved,
                                              bool with_narrow) {
  std::vector<GrowthSource<Dim>> places;
  for (const Point<Dim>& x : unresolved) places.push_back({x, 0});
  const std::vector<double> d = spacing_at(level, places);
  for (std::size_t k = 0; k < places.size(); ++k) places[k].d = d[k];
  std::vector<GrowthSource<Dim>> result;
  if (places.empty() || with_narrow) result = narrow_points(level, places);
  for (const GrowthSource<Dim>& place : places)
    result.push_back({place.x, method::kHeldTo * place.d});
  return result;
}

// Returns the smallest d that is useful for level sets: their resolution, since their triangles
// follow them no more closely. 0 without level sets.
double resolution_of(const PlaneDomain&) { return 0; }
double resolution_of(const VolumeDomain& domain) {
  double coarsest = 0;
  for (const auto& set : domain.level_sets().sets) coarsest = std::max(coarsest, set->resolution());
  return coarsest;
}

}  // namespace

template <int Dim>
void apply_local_reductions(const Communicator& comm, PlacedSpacing<Dim>& placed,
                            const Settings& settings) {
  placed.d = placed.d.without_reductions();
  if (placed.held.places.empty()) return;
  const double growth = settings.growth_limit > 0
                            ? std::min(settings.growth_limit, method::kGrowthFollowed)
                            : method::kGrowthFollowed;
  collective_try(comm, [&] { placed.d.reduce_at(placed.held.places, growth); });
}

template <int Dim>
View<char> held_nodes(const Level<Dim>& level, const PlacedSpacing<Dim>& placed) {
  if (placed.held.places.empty()) return {};
  const View<double> d = spacing_at_nodes(level, level.geometry.spacing());
  const View<double> unheld = spacing_at_nodes(level, placed.d.without_reductions());
  View<char> held;
  collective_try(*level.comm, [&] {
    held = make_view<char>("pnpbs::held_nodes", level.nodes.count);
    for_each("pnpbs::held_nodes", level.nodes.count,
             [&](std::int64_t i) { held(i) = d(i) < unheld(i); });
  });
  return held;
}

template <int Dim>
bool add_unresolved_points(const Level<Dim>& level, const Unresolved<Dim>& unresolved,
                           LocalReduction<Dim>& held) {
  const Communicator& comm = *level.comm;
  const auto global_count = [&] {
    return static_cast<std::int64_t>(
        comm.allreduce_sum(static_cast<std::uint64_t>(level.owned_count())));
  };
  if (held.rounds >= level.settings.conforming_rounds) return false;
  // With so many points the whole shape is unresolved, and one rank should not store them all.
  // Corners of elements with small angles may be points of several ranks, so the elements are
  // counted instead.
  const bool small = unresolved.small_angles > 0;
  const std::int64_t found =
      small ? unresolved.small_angles
            : static_cast<std::int64_t>(comm.allreduce_sum(unresolved.places.size()));
  if (found > std::max(global_count(), small ? kFewElements : std::int64_t{0})) return false;
  if (held.rounds++ == 0) held.start_nodes = global_count();
  // Layers inside a body may be thinner than d: nodes opposite each other suffice there.
  const bool with_narrow = held.rounds > method::kRoundsOfHalves && !unresolved.inner_only;
  const std::vector<GrowthSource<Dim>> wanted =
      places_to_hold<Dim>(level, gathered<Dim>(comm, unresolved.places), with_narrow);
  const std::vector<double> d = spacing_at(level, wanted);
  if (held.rounds == 1 && !d.empty()) held.least_before = *std::ranges::min_element(d);
  const double finest = resolution_of(level.geometry.domain());
  const std::size_t before = held.places.size();
  for (std::size_t k = 0; k < wanted.size(); ++k)
    if (const double to = std::max(wanted[k].d, finest); to < d[k])
      held.places.push_back({wanted[k].x, to});
  return held.places.size() > before;
}

template <int Dim>
bool exceeds_node_growth(double expected_nodes, const LocalReduction<Dim>& held, bool conforms) {
  const auto nodes = static_cast<double>(held.start_nodes);
  return expected_nodes >
         (conforms ? method::kMaxGrowthOfNodes * nodes
                   : std::max(method::kMaxGrowthToConform * nodes, method::kFewNodesToConform));
}

template <int Dim>
Warning warning_of_too_many(double expected_nodes, const LocalReduction<Dim>& held) {
  const GrowthSource<Dim>& finest = *std::ranges::min_element(
      held.places, [](const auto& p, const auto& q) { return p.d < q.d; });
  const auto nodes = static_cast<std::int64_t>(expected_nodes);
  return {WarningCode::not_conforming,
          "the shape needs about " + std::to_string(nodes) + " nodes or more, with a spacing of " +
              rounded_text(finest.d) + " at " + rounded_point_text<Dim>(finest.x) +
              ", and the given "
              "spacing would give " +
              std::to_string(held.start_nodes) +
              ": set the option resolve, or a smaller spacing there",
          nodes, finest.d};
}

template <int Dim>
Warning warning_of_reduced_spacing(const LocalReduction<Dim>& held, std::int64_t nodes) {
  const GrowthSource<Dim>& finest = *std::ranges::min_element(
      held.places, [](const auto& p, const auto& q) { return p.d < q.d; });
  return {WarningCode::spacing_held,
          "the spacing did not resolve the shape at " + std::to_string(held.places.size()) +
              " places, and is reduced there, to " + rounded_text(finest.d) + " at " +
              rounded_point_text<Dim>(finest.x) + ": " + std::to_string(nodes) +
              " nodes instead of " + std::to_string(held.start_nodes) +
              " (option conforming_rounds, 0 for d as it is given)",
          std::ssize(held.places), finest.d};
}

template void apply_local_reductions(const Communicator&, PlacedSpacing<2>&, const Settings&);
template View<char> held_nodes(const Level<2>&, const PlacedSpacing<2>&);
template bool add_unresolved_points<2>(const Level<2>&, const Unresolved<2>&, LocalReduction<2>&);
template bool exceeds_node_growth(double, const LocalReduction<2>&, bool);
template Warning warning_of_reduced_spacing(const LocalReduction<2>&, std::int64_t);
template Warning warning_of_too_many(double, const LocalReduction<2>&);
template void apply_local_reductions(const Communicator&, PlacedSpacing<3>&, const Settings&);
template View<char> held_nodes(const Level<3>&, const PlacedSpacing<3>&);
template bool add_unresolved_points<3>(const Level<3>&, const Unresolved<3>&, LocalReduction<3>&);
template bool exceeds_node_growth(double, const LocalReduction<3>&, bool);
template Warning warning_of_reduced_spacing(const LocalReduction<3>&, std::int64_t);
template Warning warning_of_too_many(double, const LocalReduction<3>&);

}  // namespace pnpbs
