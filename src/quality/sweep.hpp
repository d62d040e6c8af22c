// SPDX-License-Identifier: BSD-3-Clause
// Finishing sweeps in the plane: every inner node moves part of the way to the mean of its Delaunay
// neighbours. All nodes move from their old positions (Jacobi). A guard rejects a move if a
// triangle of the node gets worse that is or becomes bad, whether the other two corners move or
// stay.
#pragma once

#include "delaunay/delaunay_stars.hpp"
#include "geometry/clearance.hpp"
#include "method/constants.hpp"
#include "neighbors/near_edges.hpp"

namespace pnpbs {

// Parameters of one sweep.
struct SweepRule {
  double weight;                                 // share of the vector from the node to its target
  double max_move = method::kSweepMaxMove;       // largest displacement of a node [d]
  double bad_below = method::kSweepGuardsBelow;  // bound of bad triangles [quality, 2 r_in / R]
};

// Runs one sweep over all nodes. `proposed` and `allowed` are scratch arrays with one entry per
// node.
void sweep(Nodes<2>& nodes, const DelaunayStars& stars, const NearEdges& near_edges,
           const SizedTree<2>& map, const SweepRule& rule, Field<2>& proposed, View<char>& allowed);

// Sets proposed(i) to the position of node i after `move`. The move is shortened to rule.max_move,
// and the position is kept off the boundary. It is the old position if no position clear of the
// boundary exists.
void propose_move(const Nodes<2>& nodes, const NearEdges& near_edges, const SizedTree<2>& map,
                  const SweepRule& rule, std::int64_t i, Point<2> move, Field<2>& proposed);
// Sets proposed(i) to the current position of node i.
void propose_current_position(const Nodes<2>& nodes, std::int64_t i, Field<2>& proposed);
// Moves every node to its proposed position if the guard allows it. Writes the decisions of the
// guard to `allowed`.
void apply_allowed_moves(Nodes<2>& nodes, const DelaunayStars& stars, const SweepRule& rule,
                         const Field<2>& proposed, View<char>& allowed);

}  // namespace pnpbs
