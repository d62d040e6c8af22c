// SPDX-License-Identifier: BSD-3-Clause
// A check that ghosts reach far enough. A node is inexact on a rank if its position may differ from
// that on its owner. Ghosts are so deep that owned nodes are never inexact before the next
// exchange. Builds with PNPBS_COUNT_UNKNOWN_USES verify this and count violations in
// Level::unknown_uses. In other builds these functions do nothing.
#pragma once

#include <cstdint>
#include <unordered_set>

namespace pnpbs {

template <int Dim>
struct Level;

#ifdef PNPBS_COUNT_UNKNOWN_USES
inline constexpr bool kCountsUnknownUses = true;
#else
inline constexpr bool kCountsUnknownUses = false;
#endif

using InexactNodes = std::unordered_set<std::int64_t>;  // ids of inexact nodes

// Updates the inexact nodes before a step with this many evaluations of the force. A node becomes
// inexact if an inexact node is within the range of the force, or may be in a leaf unknown to this
// rank.
template <int Dim>
void track_inexact_nodes(Level<Dim>& level, int evaluations);

// Counts the owned nodes that are inexact, and clears the set, because an exchange follows.
template <int Dim>
void count_inexact_nodes(Level<Dim>& level);

// Counts the owned nodes that an event of this depth decides about with inexact data. The ghosts
// must be those of an exchange right before. Builds the lists of all nodes.
template <int Dim>
void count_uses_by_event(Level<Dim>& level, int hops);

}  // namespace pnpbs
