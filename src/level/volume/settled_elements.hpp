// SPDX-License-Identifier: BSD-3-Clause
// Elements whose boundary is a closed surface. See element_labels.hpp for the method.
#pragma once

#include <array>
#include <cstdint>

#include "level/level.hpp"
#include "level/volume/open_faces.hpp"

namespace pnpbs {

// Returns the number of disks that the surfaces form around a node. On surfaces that bound the
// domain it is 1, except where bodies touch in a corner. It is 0 for other nodes.
std::int64_t disks_of_surfaces(const Level<3>& level, std::int64_t i);
// Returns whether the open faces around such a node do not form that number of disks.
bool lacks_disks(const Level<3>& level, std::int64_t i, const FaceFan& fan);
// Returns whether the boundary is torn at an owned node: a free node has open faces, or a surface
// node lacks its disks. Returns false for ghosts.
bool is_torn_around(const Level<3>& level, std::int64_t i);

// Returns whether the corners of a face lie side by side on one surface.
bool lies_along_surface(const Level<3>& level, const std::array<std::int64_t, 3>& corners);

// Changes labels of tetrahedra around nodes where the boundary is torn, until it is a surface of
// the same topology as that of the domain, if such labels are found. Requires lists and stars whose
// labels follow from centroids. Recomputes the stars with changed labels. Returns the number of
// torn nodes over all ranks. All ranks must call it, and if one rank throws, all ranks throw.
std::int64_t settle_elements(Level<3>& level, int rounds);
inline std::int64_t settle_elements(Level<2>&, int) { return 0; }

// Limits of the search for labels: while nodes may still be inserted, and for the elements of the
// results. [rounds]
inline constexpr int kQuickRounds = 1000, kThoroughRounds = 20000;

}  // namespace pnpbs
