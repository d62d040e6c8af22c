// SPDX-License-Identifier: BSD-3-Clause
// The triangle that closes a whole sphere. It lies around the point that the chart is projected
// from, so that in the chart it covers everything outside the domain, with reversed orientation.
#pragma once

#include <array>
#include <cstdint>

#include "level/level.hpp"

namespace pnpbs {

// Returns whether the level has that triangle. If so, points that are near each other in the chart
// need not be near on the sphere, and far fewer nodes must be known than a distance in the chart
// contains.
inline bool is_closed_sphere(const Level<2>& level) {
  return level.geometry.domain().closing() != nullptr;
}
inline bool is_closed_sphere(const Level<3>&) { return false; }

// Adds the triangle to those stars of its corners that are on this rank. Does nothing on other
// domains.
void close_sphere(Level<2>& level);
inline void close_sphere(Level<3>&) {}
// Frees the nodes in the margin of the patch, so that the lattice of the patch and that of the
// other nodes can adapt to each other on both sides of its rim.
void free_margin(Level<2>& level);
inline void free_margin(Level<3>&) {}
// Fixes the nodes that were freed, at their present positions. In further steps the bubbles of the
// chart would push them towards the point of projection. The next exchange updates the ghosts.
void hold_margin(Level<2>& level);
inline void hold_margin(Level<3>&) {}
// Determines level.margin from the nodes of a checkpoint. Collective.
void recognise_margin(Level<2>& level);
inline void recognise_margin(Level<3>&) {}
// Returns whether only nodes of the patch may lie at this point.
inline bool is_closed_at(const Level<2>& level, const Point<2>& x) {
  return level.geometry.domain().is_closed_at(x, level.margin == PatchMargin::free);
}
inline bool is_closed_at(const Level<3>&, const Point<3>&) { return false; }
// Returns whether these corners are those of the closing triangle.
bool closes_sphere(const Level<2>& level, const std::array<std::int64_t, 3>& corners);

}  // namespace pnpbs
