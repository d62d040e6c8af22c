// SPDX-License-Identifier: BSD-3-Clause
// Removal of surplus nodes: inner nodes with only three or four neighbours. Without such a node its
// neighbours fill the hole with better triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "base/nodes.hpp"
#include "delaunay/delaunay_stars.hpp"

namespace pnpbs {

// Removes surplus nodes from the stars where this raises the smallest quality, and returns them in
// memory order. The caller must delete them from the nodes. Two adjacent candidates both stay, so
// that the decision for a node depends on the stars of its neighbours alone.
std::vector<std::int32_t> remove_surplus_nodes(const Nodes<2>& nodes, DelaunayStars& stars);

}  // namespace pnpbs
