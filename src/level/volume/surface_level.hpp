// SPDX-License-Identifier: BSD-3-Clause
// Bubbles on the surfaces of a level, while there are none inside: the first nodes, new nodes among
// them, and the nodes for a level of half the spacing. The method is that of the plane, except that
// nodes walk along the surface and stars are found in tangent planes.
#pragma once

#include <cstdint>

#include "domain/volume/surface.hpp"
#include "initial/incoming_nodes.hpp"
#include "level/level.hpp"

namespace pnpbs {

// Returns the settings for bubbles on surfaces: the pair law, schedule and population control of
// the plane.
Settings surface_settings(const Settings& inside);

// Stores the feature nodes, which are laid again, and `on_surfaces`, thinned, as the nodes of the
// level. If begin_anew is true, a fill of the surfaces replaces `on_surfaces`. Surface nodes move
// from then on. A feature node keeps the id of the node at its position in `on_features`. Returns
// how many of this rank's nodes were deleted because they were too dense for d. All ranks must call
// it, and if one rank throws, all ranks throw.
std::int64_t put_surface_nodes(Level<3>& level, IncomingNodes<3> on_surfaces,
                               const IncomingNodes<3>& on_features, bool begin_anew);
// Returns a new surface node at this point that counts as placed for d.
IncomingNode<3> new_surface_node(const LevelGeometry<3>& geometry, const SurfacePoint& at,
                                 double d = 0);
// Stops the surface nodes. After this call, only inner nodes move.
void fix_surface_nodes(Level<3>& level);
// Returns the owned boundary nodes.
IncomingNodes<3> surface_nodes(const Level<3>& level);
// Moves nodes on triangles of a level set to where it is 0, if that point is within the error of
// the triangle.
void put_on_level_sets(const LevelGeometry<3>& geometry, IncomingNodes<3>& nodes);
// Does the same for the nodes of the level. All ranks must call it, and if one rank throws, all
// ranks throw.
void put_on_level_sets(Level<3>& level);

// Returns the position of a new bubble beside a surface node (see free_place).
Point<3> free_place_on_surface(const Level<3>& level, std::int64_t i);
// Returns the facet reached by walking from a surface node to this point.
std::int32_t facet_at(const Level<3>& level, std::int64_t from, const Point<3>& place);

// Returns the point reached from a surface node by moving this length along the surface.
// `direction` need not be tangential. Returns the present point if the move comes too close to a
// feature and closer than now.
SurfacePoint go_along_surface(const Level<3>& level, std::int64_t i, const Point<3>& direction,
                              double length);

// Moves surface nodes towards the mean of their neighbours within the surface, in this many sweeps.
// All ranks must call it, and if one rank throws, all ranks throw.
void sweep_on_surfaces(Level<3>& level, std::int64_t sweeps);

// Appends new nodes in the middle of edges within the surfaces, at owned nodes where d falls by the
// factor kHalvedOnSurfaces or more. Requires the lists that surface_star() uses.
void append_surface_midpoints(const Level<3>& level, const View<double>& next_spacing,
                              IncomingNodes<3>& refined);

}  // namespace pnpbs
