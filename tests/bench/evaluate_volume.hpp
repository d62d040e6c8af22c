// SPDX-License-Identifier: BSD-3-Clause
// The Delaunay triangulation of nodes in space by another library (CGAL).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace pnpbs_bench {

// By their corners' places among the nodes, each tetrahedron's sorted.
std::vector<std::array<std::int64_t, 4>> reference_tetrahedra(
    const std::vector<std::array<double, 3>>& nodes);

}  // namespace pnpbs_bench
