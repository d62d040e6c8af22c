// SPDX-License-Identifier: BSD-3-Clause
// Repair of the first kind of defect: a node that only three or four others surround is mostly one
// too many. Without it they fill its place with better triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "base/nodes.hpp"
#include "delaunay/delaunay_stars.hpp"

namespace pnpbs {

// Takes such nodes out of the stars where that raises the least quality there, and returns them in
// the order of memory; they themselves stay for the caller to delete. Two of them that are
// neighbours stay both: then whether a node goes hangs on the stars of its neighbours alone.
std::vector<std::int32_t> take_out_surplus_nodes(const Nodes<2>& nodes, DelaunayStars& stars);

}  // namespace pnpbs
