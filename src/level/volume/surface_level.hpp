// SPDX-License-Identifier: BSD-3-Clause
// Bubbles that fill the surfaces of a level: its first nodes, while there are none inside, new ones
// among them, and those of a level with half the spacing. As in the plane, but that nodes walk on
// the surface, and that their stars are found in tangent planes.
#pragma once

#include <cstdint>

#include "domain/volume/surface.hpp"
#include "initial/incoming_nodes.hpp"
#include "level/level.hpp"

namespace pnpbs {

// On surfaces bubbles have the laws, the schedule and the population of the plane.
Settings surface_settings(const Settings& inside);

// The nodes of feature edges, which are laid afresh, and these on surfaces become the nodes of the
// level; if `begin_anew`, a fill on the surfaces. Those on surfaces move from now on. A node of a
// feature edge keeps the id of the one in its place among `on_features`. Returns how many of this
// rank's were too dense for d. Collective.
std::int64_t put_surface_nodes(Level<3>& level, IncomingNodes<3> on_surfaces,
                               const IncomingNodes<3>& on_features, bool begin_anew);
// A new one there, placed for d.
IncomingNode<3> new_surface_node(const LevelGeometry<3>& geometry, const SurfacePoint& at,
                                 double d = 0);
// They rest: from now on those inside move.
void fix_surface_nodes(Level<3>& level);
// The owned nodes of the boundary.
IncomingNodes<3> surface_nodes(const Level<3>& level);
// Those on triangles of a level set move to where it is 0, if that is as near as the triangle's
// error.
void put_on_level_sets(const LevelGeometry<3>& geometry, IncomingNodes<3>& nodes);
// The same of the level's own. Collective.
void put_on_level_sets(Level<3>& level);

// The free place beside a sparse bubble on a surface: see free_place.
Point<3> free_place_on_surface(const Level<3>& level, std::int64_t i);
// The facet that one comes to who walks from a node on a surface there.
std::int32_t facet_at(const Level<3>& level, std::int64_t from, const Point<3>& place);

// Where a node on a surface comes to that goes that length along it, in a direction that may rise
// out of its tangent plane; where it is if that would be too near to a feature, and nearer than
// now.
SurfacePoint go_along_surface(const Level<3>& level, std::int64_t i, const Point<3>& direction,
                              double length);

// So many sweeps towards the mean of the neighbours within the surface. Collective.
void sweep_on_surfaces(Level<3>& level, std::int64_t sweeps);

// New nodes in the middle of the edges within the surfaces, of those owned nodes i where
// is_refined(i). After make_lists_and_stars or the same for surfaces.
void append_surface_midpoints(const Level<3>& level, const View<double>& next_spacing,
                              IncomingNodes<3>& refined);

}  // namespace pnpbs
