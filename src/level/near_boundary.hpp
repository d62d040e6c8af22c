// SPDX-License-Identifier: BSD-3-Clause
// The boundary near nodes: which nodes see each other past it, and how inner nodes keep their
// distance from it.
// NearBoundary<2> and NearBoundary<3> have these members in common:
//   - near_leaves(tree, radius) returns what is near the leaves of a tree, once per tree; adopt()
//     stores it.
//   - reset(geometry) adopts another boundary.
//   - build(nodes, at, buckets, map, geometry) finds what is within radius() * d_i of each node,
//     for the positions `at`. It is called at every rebuild of the lists. In space it examines only
//     the nodes that get lists, and add() those that get them later.
//   - visibility(nodes, map, geometry) returns the visibility test for AdjacencyList::build. In
//     space it records the nodes from which others are hidden.
//   - within(i, reach) returns whether the boundary is closer to node i than `reach`, which may be
//     at most radius() * d_i. In space the node must have a list.
//   - constrains(nodes, i, reach) returns whether the boundary may block node i if steps lead no
//     farther than `reach`.
//   - hold_off(i, nodes, map, geometry, to) returns the position of node i for the desired position
//     `to`. A node on a surface is assigned to the facet at that position.
#pragma once

#include "level/plane/near_boundary.hpp"
#include "level/volume/near_boundary.hpp"
