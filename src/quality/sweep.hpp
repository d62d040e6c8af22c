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
           const DomainMap<2>& map, const SweepRule& rule, Field<2>& proposed, View<char>& allowed);

}  // namespace pnpbs
