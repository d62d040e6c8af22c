// SPDX-License-Identifier: BSD-3-Clause
// The one triangle of a whole sphere that its chart turns inside out: that around the point which
// is projected from. In the chart it is all that lies around the domain.
#pragma once

#include <array>
#include <cstdint>

#include "level/level.hpp"

namespace pnpbs {

// Is that triangle there? Then what is near another place in the chart need not be near on the
// sphere, and far less has to be known than lies within a length of the chart.
inline bool is_closed_sphere(const Level<2>& level) {
  return level.geometry.domain().closing() != nullptr;
}
inline bool is_closed_sphere(const Level<3>&) { return false; }

// Adds it to the stars of its corners, as far as they are here. No other part of the domain does
// anything.
void close_sphere(Level<2>& level);
inline void close_sphere(Level<3>&) {}
// Frees the nodes in the margin of the patch: the lattice there and that of the others, which came
// to it, then meet half-way.
void free_margin(Level<2>& level);
inline void free_margin(Level<3>&) {}
// Fixes those that were freed, where they are by now: in steps the bubbles of the chart would press
// towards the point, and go there. The next exchange tells the ghosts.
void hold_margin(Level<2>& level);
inline void hold_margin(Level<3>&) {}
// Of nodes that come from a checkpoint, what those in the margin do. Collective.
void recognise_margin(Level<2>& level);
inline void recognise_margin(Level<3>&) {}
// Is it a place that only nodes of the patch may have?
inline bool is_closed_at(const Level<2>& level, const Point<2>& x) {
  return level.geometry.domain().is_closed_at(x, level.margin == PatchMargin::free);
}
inline bool is_closed_at(const Level<3>&, const Point<3>&) { return false; }
// Is it that triangle? By its nodes.
bool closes_sphere(const Level<2>& level, const std::array<std::int64_t, 3>& corners);

}  // namespace pnpbs
