// SPDX-License-Identifier: BSD-3-Clause
#include "level/time_integration.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dynamics/pair_laws.hpp"
#include "geometry/clearance.hpp"
#include "level/reach.hpp"

namespace pnpbs {

template <int Dim>
Field<Dim>& TimeIntegration<Dim>::scratch(const Nodes<Dim>& nodes) {
  reserve_field<Dim>(next_, "pnpbs::TimeIntegration::next", nodes.capacity());
  for (int k = 0; k < Dim; ++k) next_[k](nodes.count) = kFarAway;
  return next_;
}

template <int Dim>
void TimeIntegration<Dim>::step(Nodes<Dim>& nodes, Neighbourhood<Dim>& neighbourhood,
                                const SizedTree<Dim>& map, const LevelGeometry<Dim>& geometry,
                                const Settings& settings) {
  step(settings.predictor_corrector ? Scheme::predictor_corrector : Scheme::damped, nodes,
       neighbourhood, map, geometry, settings);
}

template <int Dim>
void TimeIntegration<Dim>::runge_kutta_step(Nodes<Dim>& nodes, Neighbourhood<Dim>& neighbourhood,
                                            const SizedTree<Dim>& map,
                                            const LevelGeometry<Dim>& geometry,
                                            const Settings& settings) {
  step(Scheme::runge_kutta, nodes, neighbourhood, map, geometry, settings);
}

template <int Dim>
void TimeIntegration<Dim>::step(Scheme scheme, Nodes<Dim>& nodes, Neighbourhood<Dim>& neighbourhood,
                                const SizedTree<Dim>& map, const LevelGeometry<Dim>& geometry,
                                const Settings& settings) {
  scratch(nodes);
  if (settings.cubic_law)
    move_by(CubicLaw{}, scheme, nodes, neighbourhood.lists(), settings);
  else if (settings.bubble_dimension < Dim)
    move_by(OnSurface<LinearPush>{{1, settings.rest_length}}, scheme, nodes, neighbourhood.lists(),
            settings);
  else
    move_by(DefaultLaw<Dim>{1, settings.rest_length}, scheme, nodes, neighbourhood.lists(),
            settings);
  accept(nodes, neighbourhood, map, geometry, settings);
}

template <int Dim>
template <class Law>
void TimeIntegration<Dim>::move_by(const Law& law, Scheme scheme, Nodes<Dim>& nodes,
                                   const AdjacencyList<Dim>& lists, const Settings& settings) {
  switch (scheme) {
    case Scheme::damped:
      return damped_step<Dim>(nodes, lists, law, settings.motion, next_);
    case Scheme::predictor_corrector:
      return predictor_corrector_step<Dim>(nodes, lists, law, settings.motion, stages_, next_);
    case Scheme::runge_kutta:
      return pnpbs::runge_kutta_step<Dim>(nodes, lists, law, settings.motion, stages_, next_);
  }
}

// Corrects new positions that are too close to the boundary, and then makes them the positions.
template <int Dim>
void TimeIntegration<Dim>::accept(Nodes<Dim>& nodes, Neighbourhood<Dim>& neighbourhood,
                                  const SizedTree<Dim>& map, const LevelGeometry<Dim>& geometry,
                                  const Settings& settings) {
  constexpr std::int64_t kChunk = 64;
  const std::int64_t chunks = (nodes.count + kChunk - 1) / kChunk;
  const double meeting = meeting_radius(settings);
  const bool all = neighbourhood.listed() == ListsOf::all_nodes;
  const NearBoundary<Dim>& near_boundary = neighbourhood.near_boundary();
  if (static_cast<std::int64_t>(squares_.extent(0)) < chunks)
    squares_ = make_view<double>("pnpbs::TimeIntegration::squares", chunks);
  for_each("pnpbs::TimeIntegration::accept", chunks, [&](std::int64_t c) {
    const std::int64_t first = c * kChunk, last = std::min(first + kChunk, nodes.count);
    for (std::int64_t i = first; i < last; ++i)
      if ((all || nodes.owned(i)) && nodes.moves(i) &&
          near_boundary.constrains(nodes, i, meeting * nodes.d(i)))
        hold_off_boundary(i, nodes, near_boundary, map, geometry, settings);
    squares_(c) = neighbourhood.squared_displacement(nodes, next_, first, last);
  });
  neighbourhood.set_max_displacement(
      std::sqrt(max_of("pnpbs::TimeIntegration::max_displacement", chunks, 0.0,
                       [&](std::int64_t c) { return squares_(c); })));
  std::swap(nodes.x, next_);
}

template <int Dim>
void TimeIntegration<Dim>::hold_off_boundary(std::int64_t i, Nodes<Dim>& nodes,
                                             const NearBoundary<Dim>& near_boundary,
                                             const SizedTree<Dim>& map,
                                             const LevelGeometry<Dim>& geometry,
                                             const Settings& settings) {
  const Point<Dim> from = nodes.position(i), to = point_at<Dim>(next_, i),
                   kept = nodes.cell.rounded(near_boundary.hold_off(i, nodes, map, geometry, to));
  for (int k = 0; k < Dim; ++k) {
    if (kept[k] != to[k]) nodes.v[k](i) = (kept[k] - from[k]) / settings.motion.dt;
    next_[k](i) = kept[k];
  }
}

template class TimeIntegration<2>;
template class TimeIntegration<3>;

}  // namespace pnpbs
