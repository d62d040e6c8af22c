// SPDX-License-Identifier: BSD-3-Clause
// The refinement of a level: its nodes and new ones between them, for a level of finer spacing.
#pragma once

#include "initial/incoming_nodes.hpp"
#include "level/level.hpp"

namespace pnpbs {

// Returns the start nodes for a level of another spacing: the owned nodes and, where the spacing is
// finer, new ones on the edges of their stars and in their triangles. If it is half of the present
// one, there is one new node in the middle of every edge. All ranks must call it, and if one rank
// throws, all ranks throw.
template <int Dim>
IncomingNodes<Dim> refined(Level<Dim>& level, const Spacing<Dim>& next);

}  // namespace pnpbs
