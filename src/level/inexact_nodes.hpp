// SPDX-License-Identifier: BSD-3-Clause
// Which nodes a rank may not have where their owners have them. Ghosts reach so far that these are
// never owned when the next exchange comes; in builds that look (PNPBS_COUNT_UNKNOWN_USES) that is
// seen to be so, and what is not is counted in Level::unknown_uses. Elsewhere this is nothing.
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

using InexactNodes = std::unordered_set<std::int64_t>;  // ids

// Before nodes move by so many evaluations of the force: they are inexact then if what it reaches
// is, or may be in leaves that this rank does not know.
template <int Dim>
void track_inexact_nodes(Level<Dim>& level, int evaluations);

// Before an exchange, after which none are: owned ones were used beyond what is known.
template <int Dim>
void count_inexact_nodes(Level<Dim>& level);

// For an event that decides by the lists, so many hops far, with the ghosts of an exchange right
// before it. Makes the lists of all nodes.
template <int Dim>
void count_uses_by_event(Level<Dim>& level, int hops);

}  // namespace pnpbs
