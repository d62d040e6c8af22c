// SPDX-License-Identifier: BSD-3-Clause
// A number for where the nodes of a level are, of all ranks: nodes that come, go, move by a bit or
// get another d change it.
#pragma once

#include <cstdint>

#include "level/level.hpp"

namespace pnpbs {

// The same on all ranks, however the nodes are distributed; never 0. Collective.
template <int Dim>
std::uint64_t node_digest(const Level<Dim>& level);

}  // namespace pnpbs
