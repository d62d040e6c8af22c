// SPDX-License-Identifier: BSD-3-Clause
// Triangles that are none, and those given twice, are taken out so that surfaces stay closed.
#pragma once

#include <string>
#include <vector>

#include "base/warning.hpp"
#include "surfaces/triangulation.hpp"

namespace pnpbs {

// Takes out triangles two of whose corners are one vertex, or one of whose corners lies within the
// tolerance of the opposite edge: there, triangles on the other side of the edge are cut in two. So
// are those that are flat but for the rounding of a file's numbers: within a thousand tolerances,
// and with an angle of nearly 180 degrees. Warns if there are any.
void remove_thin_triangles(Triangulation& surface, double tolerance,
                           std::vector<Warning>& warnings);

// Keeps the first of those of one source that have the same corners, with a warning. Throws
// Error(ErrorKind::domain) if they are of two sources.
void remove_duplicate_triangles(Triangulation& surface, std::vector<Warning>& warnings);

}  // namespace pnpbs
