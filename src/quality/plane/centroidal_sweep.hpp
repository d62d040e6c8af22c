// SPDX-License-Identifier: BSD-3-Clause
// A sweep that takes every inner node to the centroid of its Voronoi cell (S. Lloyd, IEEE Trans.
// Inf. Theory 28, 1982, 129-137), as far as the guard of the finishing sweeps lets it.
#pragma once

#include "quality/plane/cell_centroids.hpp"
#include "quality/sweep.hpp"

namespace pnpbs {

// Moves the nodes; `proposed` and `allowed` are scratch, one entry per node.
void centroidal_sweep(Nodes<2>& nodes, const DelaunayStars& stars, const NearEdges& near_edges,
                      const SizedTree<2>& map, const Embedding<2>& embedding, const SweepRule& rule,
                      Field<2>& proposed, View<char>& allowed);

}  // namespace pnpbs
