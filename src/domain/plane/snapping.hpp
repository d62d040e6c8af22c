// SPDX-License-Identifier: BSD-3-Clause
// Moves loose ends of curves, and fixed nodes, onto curves that they miss by a little. Otherwise a
// fracture that ends just short of a side would leave triangles with an angle of 0 degrees.
#pragma once

#include <optional>
#include <vector>

#include "base/warning.hpp"
#include "domain/domain_base.hpp"
#include "domain/plane/curve_source.hpp"

namespace pnpbs {

// Largest distance over which points are moved by default, in units of the longest side of the
// domain's bounding box. Coordinates in single precision are off by up to 6e-8.
inline constexpr double kSnap = 1e-7;

// Moves ends of open curves, dangling vertices of graphs and fixed nodes onto a vertex or curve
// that is no farther than `reach`, by default kSnap. Points that join_sources() joins as they are
// stay. Returns a warning of what was moved.
std::optional<Warning> snap_loose_points(std::vector<CurveSource>& sources,
                                         std::vector<FixedNode<2>>& fixed_nodes,
                                         std::optional<double> reach);

}  // namespace pnpbs
