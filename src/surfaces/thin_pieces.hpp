// SPDX-License-Identifier: BSD-3-Clause
// Closed surfaces of several pieces, some of which are much thinner than they were looked for.
#pragma once

#include "surfaces/triangulation.hpp"

namespace pnpbs {

// Takes out the pieces, bodies and cavities, that are thinner than `least` in the mean, by twice
// their volume over their area; with a warning. The lattice of a level set finds such ones here and
// not there: they are crumbs of sheets that enclose nothing.
void remove_thin_pieces(SurfaceSource& surface, double least);

}  // namespace pnpbs
