// SPDX-License-Identifier: BSD-3-Clause
// Steps that all sources of nodes have in common.
#pragma once

#include "io/node_source.hpp"
#include "placement/placement.hpp"

namespace pnpbs::io {

// Nodes of one rank in a window: large enough that a window's messages and writes are, small
// against the nodes of any rank that has many.
constexpr std::int64_t kWindow = 8192;

// 2 r_in / R: 1 for an equilateral triangle, 0 for a flat one.
float quality_of(const Point<2>& p, const Point<2>& q, const Point<2>& r);

// Makes ready what for_triangles and for_boundary_edges need, or only the order. Collective.
void prepare(Placement& placement, bool elements);

}  // namespace pnpbs::io
