// SPDX-License-Identifier: BSD-3-Clause
// A finishing sweep: every inner node goes part of the way to the mean of its Delaunay neighbours.
// All move from the old positions (Jacobi). A guard lets a node go only if none of its triangles
// gets worse that is or becomes bad, whether the other two corners move or stay.
#pragma once

#include "delaunay/delaunay_stars.hpp"
#include "geometry/clearance.hpp"
#include "method/constants.hpp"
#include "neighbors/near_edges.hpp"

namespace pnpbs {

struct SweepRule {
  double weight;                                 // share of the way
  double max_move = method::kSweepMaxMove;       // no node moves more than this many d
  double bad_below = method::kSweepGuardsBelow;  // triangle quality, 2 r_in / R
};

// Moves the nodes; `proposed` and `allowed` are scratch, one entry per node.
void sweep(Nodes<2>& nodes, const DelaunayStars& stars, const NearEdges& near_edges,
           const SizedTree<2>& map, const SweepRule& rule, Field<2>& proposed, View<char>& allowed);

// The parts of it that any sweep has. Where one would take node i by this move, as far as the rule
// and the boundary let it:
void propose_move(const Nodes<2>& nodes, const NearEdges& near_edges, const SizedTree<2>& map,
                  const SweepRule& rule, std::int64_t i, Point<2> move, Field<2>& proposed);
void propose_to_stay(const Nodes<2>& nodes, std::int64_t i, Field<2>& proposed);
// And there they go, as far as the guard lets them.
void go_where_allowed(Nodes<2>& nodes, const DelaunayStars& stars, const SweepRule& rule,
                      const Field<2>& proposed, View<char>& allowed);

}  // namespace pnpbs
