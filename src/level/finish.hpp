// SPDX-License-Identifier: BSD-3-Clause
// Finishing a level on the Delaunay stars: sweeps, and the repair of bad triangles or tetrahedra.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "level/ghost_star_depth.hpp"
#include "level/level.hpp"
#include "level/population_events.hpp"
#include "quality/element_quality.hpp"

namespace pnpbs {

// Asked between parts of the finish, on all ranks at the same place: is the rest to be left out?
// Collective.
using StopTest = std::function<bool()>;

struct FinishResults {
  PopulationCounts counts;           // of this rank
  std::vector<EdgeBand> edge_bands;  // edge length over d, of all ranks, with d from before
  bool stopped = false;
};

// So many sweeps, and the repair of bad ones if the settings ask for it. In space nodes only move,
// and their edges are yet to be measured. The nodes are valid where it is stopped. Collective.
FinishResults sweep_and_repair(
    Level<2>& level, std::int64_t sweeps, const StopTest& stops = [] { return false; });
FinishResults sweep_and_repair(
    Level<3>& level, std::int64_t sweeps, const StopTest& stops = [] { return false; });

// For finite volumes, in the plane and on spheres alone. From fresh stars, which stay, so many
// sweeps to the centroids of Voronoi cells; returns the bands of then, with d from before.
// Collective.
std::vector<EdgeBand> sweep_to_centroids(Level<2>& level, std::int64_t sweeps);
inline std::vector<EdgeBand> sweep_to_centroids(Level<3>&, std::int64_t) { return {}; }
// In at most so many rounds. Collective.
void repair_obtuse_triangles(Level<2>& level, std::int64_t rounds);
inline void repair_obtuse_triangles(Level<3>&, std::int64_t) {}

// Lists for that, of the present positions. Collective.
template <int Dim>
void prepare_finish(Level<Dim>& level);
// The same unless they are there. Collective.
template <int Dim>
void require_finish_lists(Level<Dim>& level);
// From fresh lists, the stars of the owned nodes and so many rings around them. Collective.
template <int Dim>
void make_finish_stars(Level<Dim>& level, GhostStarDepth zone);

}  // namespace pnpbs
