// SPDX-License-Identifier: BSD-3-Clause
#include "level/finish.hpp"

#include <algorithm>
#include <optional>

#include "base/execution.hpp"
#include "level/exchange.hpp"
#include "level/lists_and_stars.hpp"
#include "level/node_spacing.hpp"
#include "level/reach.hpp"
#include "method/constants.hpp"
#include "quality/plane/bad_triangles.hpp"
#include "quality/plane/centroidal_sweep.hpp"
#include "quality/plane/obtuse_triangles.hpp"
#include "quality/plane/surplus_nodes.hpp"
#include "quality/sweep.hpp"

namespace pnpbs {

namespace {

// Calls sweep_once(scratch for places, scratch for flags) so many times.
template <class Sweep>
void sweep_over_stars(Level<2>& level, std::int64_t times, const Sweep& sweep_once) {
  View<char> allowed;
  collective_try(*level.comm, [&] {
    allowed = make_view<char>("pnpbs::allowed", level.nodes.count);
    level.time_integration.scratch(level.nodes);
  });
  for (std::int64_t s = 0; s < times; ++s) {
    update_ghosts(level);
    sweep_once(level.time_integration.scratch(level.nodes), allowed);
    level.timers.add(Phase::sweeps, level.neighbourhood.nodes_listed());
  }
}

void sweep_to_means(Level<2>& level, std::int64_t times) {
  sweep_over_stars(level, times, [&](Field<2>& proposed, View<char>& allowed) {
    sweep(level.nodes, level.stars, level.neighbourhood.near_boundary().edges(), level.map(),
          level.settings.sweep, proposed, allowed);
  });
}

void repair_triangles(Level<2>& level, const TriangleMeasure& measure, std::int64_t rounds) {
  update_ghosts(level);
  std::optional<BadTriangleRepair> repair;
  collective_try(*level.comm, [&] {
    repair.emplace(level.nodes, level.stars, level.neighbourhood.near_boundary().edges(),
                   level.map(), measure);
  });
  for (std::int64_t round = 0; round < rounds; ++round) {
    update_ghosts(level);
    std::int64_t moved = 0;
    collective_try(*level.comm, [&] { moved = repair->round(); });
    if (level.comm->allreduce_sum(static_cast<std::uint64_t>(moved)) == 0) break;
  }
}

// The worst first: what bars a triangle from getting better may itself be only just good enough.
void repair_bad_triangles(Level<2>& level) {
  const RepairRule& rule = level.settings.repair;
  repair_triangles(level, measure_by_shape(std::min(rule.worst_below, rule.bad_below)),
                   rule.rounds);
  if (rule.worst_below < rule.bad_below)
    repair_triangles(level, measure_by_shape(rule.bad_below), rule.rounds);
}

// At nodes and ghosts.
void take_spacing_here(Level<2>& level) {
  const PhaseTimer timer(level.timers, Phase::spacing);
  const View<double> d = spacing_at_nodes(level, level.geometry.spacing());
  for_each("pnpbs::take_spacing_here", level.nodes.count, [&](std::int64_t i) {
    level.nodes.d(i) = level.geometry.bubble_at(level.nodes, i, d(i));
  });
}

// Whether the nodes follow d is asked after every run, so it must cost next to nothing: the stars
// of the last sweeps will do, though a few edges have other nodes by now. So will d from before the
// sweeps, but in the chart of a sphere: there it changes along the way that a node has moved, near
// the point that is projected from by several per cent.
std::vector<EdgeBand> edge_bands(Level<2>& level) {
  std::vector<EdgeBand> bands;
  update_ghosts(level);
  if (level.geometry.domain().embedding().is_sphere()) take_spacing_here(level);
  collective_try(*level.comm, [&] {
    bands = edge_bands_to_judge<2>(*level.comm, {level.nodes, level.geometry.domain().embedding()},
                                   level.stars);
  });
  return bands;
}

}  // namespace

// In blocks of a few sweeps, within which the stars stay as they are. Surplus nodes leave the stars
// before the first sweep, so that the others can fill their places, and the level after the block.
FinishResults sweep_and_repair(Level<2>& level, std::int64_t sweeps, const StopTest& stops) {
  constexpr std::int64_t kBlock = method::kSweepsOnStars;
  const bool repairs = level.settings.repair.rounds > 0;
  // The guard of a node asks where its neighbours want to go, which their stars tell. Without a
  // surplus node in between a node of the second ring may be a neighbour, too; its star changes
  // with a surplus node in the third, and whether that goes hangs on the ring around it.
  const int rings = repairs ? 4 : 1;
  FinishResults results;
  for (std::int64_t done = 0; done < std::max<std::int64_t>(sweeps, repairs ? 1 : 0);
       done += kBlock) {
    if (done > 0 && stops()) {
      results.stopped = true;
      return results;
    }
    make_finish_stars(level, {rings});
    const PhaseTimer timer(level.timers, Phase::sweeps);
    std::vector<std::int32_t> surplus;
    collective_try(*level.comm, [&] {
      if (done == 0 && repairs) surplus = take_out_surplus_nodes(level.nodes, level.stars);
    });
    sweep_to_means(level, std::min(kBlock, sweeps - done));
    const bool last = done + kBlock >= sweeps;
    if (last && repairs) repair_bad_triangles(level);
    if (last) results.edge_bands = edge_bands(level);  // while there are stars
    for (std::int32_t i : surplus) results.counts.deleted += level.nodes.owned(i);
    if (!surplus.empty()) delete_nodes(level, surplus);
    if (repairs) level.ghosts.invalidate();  // on all ranks, as some may be gone
  }
  if (sweeps == 0 && !repairs) {
    make_finish_stars(level, {});
    results.edge_bands = edge_bands(level);
  }
  return results;
}

std::vector<EdgeBand> sweep_to_centroids(Level<2>& level, std::int64_t sweeps) {
  make_finish_stars(level, {1});  // the guard of a node asks where its neighbours want to go
  const PhaseTimer timer(level.timers, Phase::sweeps);
  const SweepRule rule{1, method::kSweepMaxMove, method::kCentroidalSweepGuardsBelow};
  sweep_over_stars(level, sweeps, [&](Field<2>& proposed, View<char>& allowed) {
    centroidal_sweep(level.nodes, level.stars, level.neighbourhood.near_boundary().edges(),
                     level.map(), level.geometry.domain().embedding(), rule, proposed, allowed);
  });
  return edge_bands(level);
}

void repair_obtuse_triangles(Level<2>& level, std::int64_t rounds) {
  make_finish_stars(level, {1});  // of neighbours only one moves
  const PhaseTimer timer(level.timers, Phase::sweeps);
  repair_triangles(level, measure_of_obtuse_triangles(level.geometry.domain().embedding()), rounds);
}

}  // namespace pnpbs
