// SPDX-License-Identifier: BSD-3-Clause
// Surfaces meet in common vertices and edges only.
#pragma once

#include "surfaces/triangulation.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

// The boxes of all triangles.
BoxTree<3> tree_of(const Triangulation& surface);

// Throws Error(ErrorKind::domain) naming the first two triangles that meet elsewhere, the place,
// and how many such pairs there are. In n log n time as long as triangles have few neighbours.
void reject_crossings(const Triangulation& surface, const BoxTree<3>& tree);

}  // namespace pnpbs
