// SPDX-License-Identifier: BSD-3-Clause
// Elements whose boundary closes: see element_labels.hpp.
#pragma once

#include <array>
#include <cstdint>

#include "level/level.hpp"
#include "level/volume/open_faces.hpp"

namespace pnpbs {

// Around a node of surfaces that bound the domain, how many disks they make: one, but where bodies
// touch in a corner. 0 for other nodes.
std::int64_t disks_of_surfaces(const Level<3>& level, std::int64_t i);
// Are the open faces around such a node not that many disks?
bool lacks_disks(const Level<3>& level, std::int64_t i, const FaceFan& fan);
// Is the boundary torn at this owned node: open faces at a free node, or no disk where there is a
// surface? Ghosts are not judged.
bool is_torn_around(const Level<3>& level, std::int64_t i);

// Do the corners of a face lie side by side on one surface?
bool lies_along_surface(const Level<3>& level, const std::array<std::int64_t, 3>& corners);

// Of the stars that there are, by centroids, and the lists: around nodes where the boundary is
// torn, labels of tetrahedra are changed until it is a surface of the same topology as the
// domain's, as far as such labels are found; and these stars are found again. Returns how many
// nodes were torn, of all ranks. Collective.
std::int64_t settle_elements(Level<3>& level, int rounds);
inline std::int64_t settle_elements(Level<2>&, int) { return 0; }

// Of the search for labels: while nodes may still come, and for the elements handed out.
inline constexpr int kQuickRounds = 1000, kThoroughRounds = 20000;

}  // namespace pnpbs
