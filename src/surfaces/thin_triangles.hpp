// SPDX-License-Identifier: BSD-3-Clause
// Removes degenerate and duplicate triangles while surfaces stay closed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/warning.hpp"
#include "surfaces/triangulation.hpp"

namespace pnpbs {

// Removes triangles with two equal vertices, and triangles with a corner within `tolerance` of the
// opposite edge; the triangles across that edge are then split at the corner. Also removes
// triangles that are flat up to the rounding of numbers in files: with a height below a thousand
// tolerances and an angle of nearly 180 degrees. Warns if there are any.
void remove_thin_triangles(Triangulation& surface, double tolerance,
                           std::vector<Warning>& warnings);

// The same for pieces of triangles, without a warning. Flat pieces with a larger height stay. Where
// this does not end, short edges are collapsed: `merged` lists the vertices that were merged, each
// with the one that stays, in the order of merging. Returns a triangle that is still too thin if
// that does not suffice.
std::optional<std::int32_t> remove_thin_pieces(Triangulation& surface, double tolerance,
                                               std::vector<std::array<std::int32_t, 2>>& merged);

// Removes all but the first of the triangles of one source that have the same corners, with a
// warning. Throws Error(ErrorKind::domain) if they belong to two sources.
void remove_duplicate_triangles(Triangulation& surface, std::vector<Warning>& warnings);

}  // namespace pnpbs
