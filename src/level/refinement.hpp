// SPDX-License-Identifier: BSD-3-Clause
// The nodes that a level hands on to a finer one: its own, and new ones between them.
#pragma once

#include "initial/incoming_nodes.hpp"
#include "level/level.hpp"

namespace pnpbs {

// What a level of another spacing begins with: the nodes of this rank and, where that is finer, new
// ones on the edges of their stars and in their triangles: where it is half of the present one, in
// the middle of every edge. Collective.
template <int Dim>
IncomingNodes<Dim> refined(Level<Dim>& level, const Spacing<Dim>& next);

}  // namespace pnpbs
