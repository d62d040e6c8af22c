// SPDX-License-Identifier: BSD-3-Clause
// Where the elements of a finished run do not fill the domain, or their boundary is torn, d does
// not resolve the shape: it is held down around these places, and the run goes on from its nodes.
#include <algorithm>

#include "base/point_text.hpp"
#include "comm/records.hpp"
#include "level/expected_nodes.hpp"
#include "level/finer_places.hpp"
#include "level/node_spacing.hpp"
#include "placement/narrow_places.hpp"
#include "placement/placement_of.hpp"
#include "spacing/held_spacing.hpp"
#include "spacing/spacing_with_places.hpp"

namespace pnpbs {

namespace {

constexpr double kHeld = 0.5;  // of d at such a place, in one round
// That is enough for most bodies. In later rounds d goes by what is narrow there, too, which takes
// more nodes. Of 32 bodies of about five parts that need rounds, at 400 nodes, 9 are torn in the
// end without it, and 1 with it.
constexpr std::int64_t kRoundsOfHalves = 1;
constexpr double kMaxNodes = 4;      // times those of the first round, or ...
constexpr double kFewNodes = 20000;  // ... so many more: beyond that, d is a mistake

// Those of all ranks, each once, in one order on all of them. Collective.
template <int Dim>
std::vector<Point<Dim>> gathered(const Communicator& comm, const std::vector<Point<Dim>>& own) {
  std::vector<Point<Dim>> all = of_all_ranks(comm, own);
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

// d at places, which must be the same on all ranks. Collective.
template <int Dim>
std::vector<double> spacing_at(const Level<Dim>& level,
                               const std::vector<GrowthSource<Dim>>& places) {
  std::vector<double> d(places.size());
  agreed(*level.comm, [&] {
    std::vector<Point<Dim>> x;
    for (const GrowthSource<Dim>& place : places) x.push_back(place.x);
    evaluate_spacing<Dim>(level.ground.spacing(), measure_of(level.ground.domain()), std::ssize(x),
                          x.data(), d.data());
  });
  return d;
}

// Half of d where the last round does not conform, and what is narrow around these places, in the
// body if there are none. Collective.
template <int Dim>
std::vector<GrowthSource<Dim>> places_to_hold(const Level<Dim>& level,
                                              const std::vector<Point<Dim>>& unresolved,
                                              std::int64_t round) {
  std::vector<GrowthSource<Dim>> places;
  for (const Point<Dim>& x : unresolved) places.push_back({x, 0});
  const std::vector<double> d = spacing_at(level, places);
  for (std::size_t k = 0; k < places.size(); ++k) places[k].d = d[k];
  std::vector<GrowthSource<Dim>> result;
  if (places.empty() || round > kRoundsOfHalves) result = narrow_places(level, places);
  for (const GrowthSource<Dim>& place : places) result.push_back({place.x, kHeld * place.d});
  return result;
}

// Triangles that stand for a level set follow it to a d that is no smaller than its resolution.
double resolution_of(const PlaneDomain&) { return 0; }
double resolution_of(const VolumeDomain& domain) {
  double coarsest = 0;
  for (const auto& set : domain.level_sets().sets) coarsest = std::max(coarsest, set->resolution());
  return coarsest;
}

}  // namespace

// The spacing that counts, from the one that would and the places where it is held down.
// Collective.
template <int Dim>
void PlacementOf<Dim>::hold_down(PlacedSpacing<Dim>& placed, const Settings& settings) const {
  placed.d = placed.unheld;
  const std::vector<GrowthSource<Dim>>& places = placed.held.places;
  if (places.empty()) return;
  const double growth = settings.growth_limit > 0 ? std::min(settings.growth_limit, kGrowthFollowed)
                                                  : kGrowthFollowed;
  agreed(*comm_, [&] {
    KnownValues<Dim> known;
    known.in_domain = places;
    placed.d = std::make_shared<SpacingWithPlaces<Dim>>(
        std::make_shared<HeldSpacing<Dim>>(placed.unheld, places, growth), std::move(known));
  });
}

// Of this rank's nodes and ghosts, those where d is held down; an empty view if there are no such
// places. Collective.
template <int Dim>
View<char> PlacementOf<Dim>::held_nodes() const {
  if (placed_.held.places.empty()) return {};
  const View<double> d = spacing_at_nodes(*level_, level_->ground.spacing());
  const View<double> unheld = spacing_at_nodes(*level_, *placed_.unheld);
  View<char> held;
  agreed(*comm_, [&] {
    held = make_view<char>("pnpbs::held_nodes", level_->nodes.count);
    for_each("pnpbs::held_nodes", level_->nodes.count,
             [&](std::int64_t i) { held(i) = d(i) < unheld(i); });
  });
  return held;
}

// The places at which the last round asks for a smaller d; false if there are none, or that was
// tried often enough. Collective.
template <int Dim>
bool PlacementOf<Dim>::add_unresolved_places(Held<Dim>& held) const {
  if (held.rounds >= level_->settings.conforming_rounds) return false;
  // Where places are that many, the shape is lost altogether; nor should one rank have them all.
  if (comm_->allreduce_sum(unresolved_.size()) > static_cast<std::uint64_t>(global_count()))
    return false;
  if (held.rounds++ == 0) held.nodes_before = global_count();
  const std::vector<GrowthSource<Dim>> wanted =
      places_to_hold<Dim>(*level_, gathered<Dim>(*comm_, unresolved_), held.rounds);
  const std::vector<double> d = spacing_at(*level_, wanted);
  const double finest = resolution_of(level_->ground.domain());
  const std::size_t before = held.places.size();
  for (std::size_t k = 0; k < wanted.size(); ++k)
    if (const double to = std::max(wanted[k].d, finest); to < d[k])
      held.places.push_back({wanted[k].x, to});
  return held.places.size() > before;
}

// Begins a round with d held down where the last one does not conform: converged, or stopped. Not
// conforming, as it is, if there is nothing to hold, it was tried often enough, or would take far
// more nodes than were asked for; then all stays as it is. Collective.
template <int Dim>
Outcome PlacementOf<Dim>::hold_spacing() {
  PlacedSpacing<Dim> placed = placed_;
  const RunState before = state_;
  Outcome outcome = Outcome::not_conforming;
  try {
    if (add_unresolved_places(placed.held)) outcome = begin_held_round(std::move(placed));
  } catch (const FinerPlaces&) {
    throw;  // it is tried again with these
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::spacing && error.kind() != ErrorKind::memory) throw;
    put_back(before);
  }
  // Of the call that the round belongs to.
  state_.dropped = before.dropped;
  state_.coarser_levels = before.coarser_levels;
  return outcome;
}

// On a level for the spacing as it is held now, with the nodes there were. Collective.
template <int Dim>
Outcome PlacementOf<Dim>::begin_held_round(PlacedSpacing<Dim> placed) {
  const Settings settings = level_->settings;
  hold_down(placed, settings);
  std::unique_ptr<Level<Dim>> next = empty_level(placed.d, settings);
  const double expected = expected_nodes(*next);
  const auto nodes = static_cast<double>(placed.held.nodes_before);
  if (expected > std::max(kMaxNodes * nodes, nodes + kFewNodes)) return Outcome::not_conforming;
  settings.node_limit().require_memory_for(expected);
  return begin_on(std::move(next), std::move(placed), settings);
}

template <int Dim>
void PlacementOf<Dim>::warn_of_held_spacing() {
  const Held<Dim>& held = placed_.held;
  if (held.places.empty()) return;
  const GrowthSource<Dim>& finest = *std::ranges::min_element(
      held.places, [](const auto& p, const auto& q) { return p.d < q.d; });
  state_.warnings.push_back(
      "the spacing did not resolve the shape at " + std::to_string(held.places.size()) +
      " places, and is held down there, to " + rounded_text(finest.d) + " at " +
      rounded_point_text<Dim>(finest.x) + ": " + std::to_string(global_count()) +
      " nodes instead of " + std::to_string(held.nodes_before) +
      " (option conforming_rounds, 0 to have d as it is given)");
}

// Of the members defined here.
template class PlacementOf<2>;
template class PlacementOf<3>;

}  // namespace pnpbs
