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

// Calls sweep_once(scratch for positions, scratch for flags) `times` times, each after an update of
// the ghosts. All ranks must call it, and if one rank throws, all ranks throw.
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

// Repairs the worst triangles first. A triangle that is barely acceptable may prevent the
// improvement of a worse one beside it.
void repair_on_stars(Level<2>& level) {
  const RepairRule& rule = level.settings.repair;
  repair_triangles(level, measure_by_shape(std::min(rule.worst_below, rule.bad_below)),
                   rule.rounds);
  if (rule.worst_below < rule.bad_below)
    repair_triangles(level, measure_by_shape(rule.bad_below), rule.rounds);
}

// Evaluates d at the present positions of nodes and ghosts. All ranks must call it, and if one rank
// throws, all ranks throw.
void take_spacing_here(Level<2>& level) {
  const PhaseTimer timer(level.timers, Phase::spacing);
  const View<double> d = spacing_at_nodes(level, level.geometry.spacing());
  for_each("pnpbs::take_spacing_here", level.nodes.count, [&](std::int64_t i) {
    level.nodes.d(i) = level.geometry.bubble_at(level.nodes, i, d(i));
  });
}

// Measures the edges over d with the stars and the d of the last sweeps, because the check follows
// every run and must be cheap. A few edges have changed since then. In the chart of a sphere d is
// evaluated again: near the point of projection it changes by several per cent along the path of a
// node.
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

// Sweeps in blocks, within which the stars do not change. Surplus nodes are taken out of the stars
// before the first sweep, so that the others can fill the gaps. They are deleted after the block.
FinishResults sweep_and_repair(Level<2>& level, std::int64_t sweeps, const StopTest& stops) {
  constexpr std::int64_t kBlock = method::kSweepsOnStars;
  const bool repairs = level.settings.repair.rounds > 0;
  // The guard of a node reads the proposed positions of its neighbours, which depend on their
  // stars. If a surplus node between them is taken out, a node of the second ring may become a
  // neighbour. Its star in turn changes with a surplus node in the third ring, which the fourth
  // ring decides about.
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
      if (done == 0 && repairs) surplus = remove_surplus_nodes(level.nodes, level.stars);
    });
    sweep_to_means(level, std::min(kBlock, sweeps - done));
    const bool last = done + kBlock >= sweeps;
    if (last && repairs) repair_on_stars(level);
    if (last) results.edge_bands = edge_bands(level);  // requires the stars
    for (std::int32_t i : surplus) results.counts.deleted += level.nodes.owned(i);
    if (!surplus.empty()) delete_nodes(level, surplus);
    if (repairs) level.ghosts.invalidate();  // on all ranks, as some ghosts may be deleted
  }
  if (sweeps == 0 && !repairs) {
    make_finish_stars(level, {});
    results.edge_bands = edge_bands(level);
  }
  return results;
}

std::vector<EdgeBand> sweep_to_centroids(Level<2>& level, std::int64_t sweeps) {
  // The guard of a node reads the proposed positions of its neighbours.
  make_finish_stars(level, {1});
  const PhaseTimer timer(level.timers, Phase::sweeps);
  const SweepRule rule{1, method::kSweepMaxMove, method::kCentroidalSweepGuardsBelow};
  sweep_over_stars(level, sweeps, [&](Field<2>& proposed, View<char>& allowed) {
    centroidal_sweep(level.nodes, level.stars, level.neighbourhood.near_boundary().edges(),
                     level.map(), level.geometry.domain().embedding(), rule, proposed, allowed);
  });
  return edge_bands(level);
}

void repair_bad_triangles(Level<2>& level) {
  make_finish_stars(level, {1});  // of two neighbours only one moves
  const PhaseTimer timer(level.timers, Phase::sweeps);
  repair_on_stars(level);
}

void repair_obtuse_triangles(Level<2>& level, std::int64_t rounds) {
  make_finish_stars(level, {1});  // of two neighbours only one moves
  const PhaseTimer timer(level.timers, Phase::sweeps);
  repair_triangles(level, measure_of_obtuse_triangles(level.geometry.domain().embedding()), rounds);
}

}  // namespace pnpbs
