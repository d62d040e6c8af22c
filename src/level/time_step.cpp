// SPDX-License-Identifier: BSD-3-Clause
#include "level/time_step.hpp"

#include "level/exchange.hpp"
#include "level/lists_and_stars.hpp"
#include "level/reach.hpp"

namespace pnpbs {

namespace {

template <int Dim>
void count_step(Level<Dim>& level) {
  level.nodes.moved();
  level.ghosts.count_step();
}

}  // namespace

template <int Dim>
void step(Level<Dim>& level, std::exception_ptr& failure) {
  attempt(failure, [&] {
    if (level.neighbourhood.needs_rebuild(level.nodes, level.settings))
      rebuild_lists_for_steps(level, lists_of_steps(level.settings));
    track_inexact_nodes(level, level.settings.evaluations_per_step());
    const PhaseTimer timer(level.timers, Phase::motion);
    level.time_integration.step(level.nodes, level.neighbourhood, level.map(), level.geometry,
                                level.settings);
    level.timers.add(Phase::motion, level.neighbourhood.nodes_listed());
  });
  count_step(level);
}

template <int Dim>
void finish_by_runge_kutta(Level<Dim>& level) {
  exchange(level, runge_kutta_hops(level.settings));
  collective_try(*level.comm, [&] {
    rebuild_lists_for_steps(level);
    track_inexact_nodes(level, kRungeKuttaStages);
    const PhaseTimer timer(level.timers, Phase::motion);
    level.time_integration.runge_kutta_step(level.nodes, level.neighbourhood, level.map(),
                                            level.geometry, level.settings);
    level.timers.add(Phase::motion, level.neighbourhood.nodes_listed());
  });
  count_step(level);
}

template void step(Level<2>&, std::exception_ptr&);
template void step(Level<3>&, std::exception_ptr&);
template void finish_by_runge_kutta(Level<2>&);
template void finish_by_runge_kutta(Level<3>&);

}  // namespace pnpbs
