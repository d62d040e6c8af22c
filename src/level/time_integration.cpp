// SPDX-License-Identifier: BSD-3-Clause
#include "level/time_integration.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "domain/clearance.hpp"
#include "dynamics/pair_laws.hpp"
#include "level/reach.hpp"

namespace pnpbs {

const Field<2>& TimeIntegration::scratch(const Nodes<2>& nodes) {
  reserve_field<2>(next_, "pnpbs::TimeIntegration::next", nodes.capacity());
  for (int k = 0; k < 2; ++k) next_[k](nodes.count) = kFarAway;
  return next_;
}

void TimeIntegration::step(Nodes<2>& nodes, Neighbourhood& neighbourhood, const DomainMap<2>& map,
                           const Settings& settings) {
  step(settings.predictor_corrector ? Scheme::predictor_corrector : Scheme::damped, nodes,
       neighbourhood, map, settings);
}

void TimeIntegration::runge_kutta_step(Nodes<2>& nodes, Neighbourhood& neighbourhood,
                                       const DomainMap<2>& map, const Settings& settings) {
  step(Scheme::runge_kutta, nodes, neighbourhood, map, settings);
}

void TimeIntegration::step(Scheme scheme, Nodes<2>& nodes, Neighbourhood& neighbourhood,
                           const DomainMap<2>& map, const Settings& settings) {
  scratch(nodes);
  if (settings.cubic_law)
    move_by(CubicLaw{}, scheme, nodes, neighbourhood.lists(), settings);
  else
    move_by(LinearPush{1, settings.rest_length}, scheme, nodes, neighbourhood.lists(), settings);
  accept(nodes, neighbourhood, map, settings);
}

template <class Law>
void TimeIntegration::move_by(const Law& law, Scheme scheme, Nodes<2>& nodes,
                              const AdjacencyList<2>& lists, const Settings& settings) {
  switch (scheme) {
    case Scheme::damped:
      return damped_step<2>(nodes, lists, law, settings.motion, next_);
    case Scheme::predictor_corrector:
      return predictor_corrector_step<2>(nodes, lists, law, settings.motion, stages_, next_);
    case Scheme::runge_kutta:
      return pnpbs::runge_kutta_step<2>(nodes, lists, law, settings.motion, stages_, next_);
  }
}

// Inner nodes near the boundary are held off it; then the new positions become the positions.
void TimeIntegration::accept(Nodes<2>& nodes, Neighbourhood& neighbourhood, const DomainMap<2>& map,
                             const Settings& settings) {
  constexpr std::int64_t kChunk = 64;
  const std::int64_t chunks = (nodes.count + kChunk - 1) / kChunk;
  const double meeting = meeting_radius(settings);
  const NearEdges& near_edges = neighbourhood.near_edges();
  if (static_cast<std::int64_t>(squares_.extent(0)) < chunks)
    squares_ = make_view<double>("pnpbs::TimeIntegration::squares", chunks);
  for_each("pnpbs::TimeIntegration::accept", chunks, [&](std::int64_t c) {
    const std::int64_t first = c * kChunk, last = std::min(first + kChunk, nodes.count);
    for (std::int64_t i = first; i < last; ++i)
      if (near_edges.edge_within(i, meeting * nodes.d(i)) && nodes.moves(i))
        hold_off_boundary(i, nodes, near_edges, map, settings);
    squares_(c) = neighbourhood.squared_displacement(nodes, next_, first, last);
  });
  neighbourhood.set_max_displacement(
      std::sqrt(max_of("pnpbs::TimeIntegration::max_displacement", chunks, 0.0,
                       [&](std::int64_t c) { return squares_(c); })));
  std::swap(nodes.x, next_);
}

void TimeIntegration::hold_off_boundary(std::int64_t i, const Nodes<2>& nodes,
                                        const NearEdges& near_edges, const DomainMap<2>& map,
                                        const Settings& settings) const {
  const Point<2> from = nodes.position(i), to = point_at<2>(next_, i);
  if (near_edges.stays_clear(i, from, to, kBoundaryClearance * nodes.d(i))) return;
  const ClearPosition<2> kept = clear_position(map, near_edges.edges_of(i), from, to, nodes.d(i));
  for (int k = 0; k < 2; ++k) {
    if (kept.position[k] != to[k])
      nodes.v[k](i) = (kept.position[k] - from[k]) / settings.motion.dt;
    next_[k](i) = kept.position[k];
  }
}

}  // namespace pnpbs
