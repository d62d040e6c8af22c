// SPDX-License-Identifier: BSD-3-Clause
// One sweep of Lloyd's iteration: every inner node moves to the centroid of its Voronoi cell (S.
// Lloyd, IEEE Trans. Inf. Theory 28, 1982, 129-137), unless the guard of the finishing sweeps
// rejects the move.
#pragma once

#include "quality/plane/cell_centroids.hpp"
#include "quality/sweep.hpp"

namespace pnpbs {

// Runs one sweep. `proposed` and `allowed` are scratch arrays with one entry per node.
void centroidal_sweep(Nodes<2>& nodes, const DelaunayStars& stars, const NearEdges& near_edges,
                      const SizedTree<2>& map, const Embedding<2>& embedding, const SweepRule& rule,
                      Field<2>& proposed, View<char>& allowed);

}  // namespace pnpbs
