// SPDX-License-Identifier: BSD-3-Clause
// Where the elements of a finished run do not fill the domain, or their boundary is torn, d does
// not resolve the shape: it is held down around these places, and the run goes on from its nodes.
#include <algorithm>

#include "base/point_text.hpp"
#include "comm/records.hpp"
#include "level/expected_nodes.hpp"
#include "level/finer_places.hpp"
#include "level/node_spacing.hpp"
#include "placement/placement_of.hpp"
#include "spacing/held_spacing.hpp"
#include "spacing/spacing_with_places.hpp"

namespace pnpbs {

namespace {

constexpr double kHeld = 0.5;        // of d at such a place, in one round
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

// The places where the last round does not conform; false if there are none where d could be less,
// or that was tried often enough. Collective.
template <int Dim>
bool PlacementOf<Dim>::add_unresolved_places(Held<Dim>& held) const {
  if (held.rounds >= level_->settings.conforming_rounds) return false;
  // Where places are that many, the shape is lost altogether; nor should one rank have them all.
  if (comm_->allreduce_sum(unresolved_.size()) > static_cast<std::uint64_t>(global_count()))
    return false;
  if (held.rounds++ == 0) held.nodes_before = global_count();
  const std::vector<Point<Dim>> places = gathered<Dim>(*comm_, unresolved_);
  std::vector<double> d(places.size());
  agreed(*comm_, [&] {
    evaluate_spacing<Dim>(level_->ground.spacing(), measure_of(*domain_), std::ssize(places),
                          places.data(), d.data());
  });
  const double finest = resolution_of(level_->ground.domain());
  const std::size_t before = held.places.size();
  for (std::size_t k = 0; k < places.size(); ++k)
    if (const double to = std::max(kHeld * d[k], finest); to < d[k])
      held.places.push_back({places[k], to});
  return held.places.size() > before;
}

// Begins a round with d held down where the last one does not conform: converged, or stopped. Not
// conforming, as it is, if there is nothing to hold, it was tried often enough, or would take far
// more nodes than were asked for; then all stays as it is. Collective.
template <int Dim>
Outcome PlacementOf<Dim>::hold_spacing() {
  PlacedSpacing<Dim> placed = placed_;
  if (!add_unresolved_places(placed.held)) return Outcome::not_conforming;
  // Of the call that the round belongs to.
  const std::int64_t dropped = dropped_;
  const int coarser_levels = coarser_levels_;
  Outcome outcome = Outcome::not_conforming;
  try {
    outcome = begin_held_round(std::move(placed));
  } catch (const FinerPlaces&) {
    throw;  // it is tried again with these
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::spacing && error.kind() != ErrorKind::memory) throw;
  }
  dropped_ = dropped;
  coarser_levels_ = coarser_levels;
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
  warnings_.push_back("the spacing did not resolve the shape at " +
                      std::to_string(held.places.size()) + " places, and is held down there, to " +
                      rounded_text(finest.d) + " at " + rounded_point_text<Dim>(finest.x) + ": " +
                      std::to_string(global_count()) + " nodes instead of " +
                      std::to_string(held.nodes_before) +
                      " (option conforming_rounds, 0 to have d as it is given)");
}

// Of the members defined here.
template class PlacementOf<2>;
template class PlacementOf<3>;

}  // namespace pnpbs
