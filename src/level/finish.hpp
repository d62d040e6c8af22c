// SPDX-License-Identifier: BSD-3-Clause
// The finish of a level on its Delaunay stars: sweeps, and the repair of bad elements.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "level/ghost_star_depth.hpp"
#include "level/level.hpp"
#include "level/population_events.hpp"
#include "quality/element_quality.hpp"

namespace pnpbs {

// A test between the parts of the finish: returns whether the rest is left out. All ranks call it
// at the same point. Collective.
using StopTest = std::function<bool()>;

// The results of sweeps and repairs.
struct FinishResults {
  PopulationCounts counts;           // on this rank
  std::vector<EdgeBand> edge_bands;  // edge length over d on all ranks, for d before the sweeps
  bool stopped = false;
};

// Does this many sweeps, and repairs bad elements if the settings request it. In space, edge_bands
// stays empty. The nodes are valid if `stops` ends it early. All ranks must call it, and if one
// rank throws, all ranks throw.
FinishResults sweep_and_repair(
    Level<2>& level, std::int64_t sweeps, const StopTest& stops = [] { return false; });
FinishResults sweep_and_repair(
    Level<3>& level, std::int64_t sweeps, const StopTest& stops = [] { return false; });

// Moves nodes towards the centroids of their Voronoi cells, for finite volumes in the plane and on
// spheres. It finds the stars once and uses them in all these sweeps. Returns the edge bands for d
// before the sweeps. All ranks must call it, and if one rank throws, all ranks throw.
std::vector<EdgeBand> sweep_to_centroids(Level<2>& level, std::int64_t sweeps);
inline std::vector<EdgeBand> sweep_to_centroids(Level<3>&, std::int64_t) { return {}; }
// Repairs bad triangles by moves of inner nodes, as sweep_and_repair() does, without a change of
// the population. All ranks must call it, and if one rank throws, all ranks throw.
void repair_bad_triangles(Level<2>& level);
inline void repair_bad_triangles(Level<3>&) {}
// Repairs obtuse triangles in at most this many rounds. All ranks must call it, and if one rank
// throws, all ranks throw.
void repair_obtuse_triangles(Level<2>& level, std::int64_t rounds);
inline void repair_obtuse_triangles(Level<3>&, std::int64_t) {}

// Exchanges ghosts and builds lists for the finish at the present positions, unless such lists
// exist. All ranks must call it, and if one rank throws, all ranks throw.
template <int Dim>
void require_finish_lists(Level<Dim>& level);
// Builds lists for the finish if necessary, and finds the stars of the owned nodes and of the
// ghosts to the depth `zone`. All ranks must call it, and if one rank throws, all ranks throw.
template <int Dim>
void make_finish_stars(Level<Dim>& level, GhostStarDepth zone);

}  // namespace pnpbs
