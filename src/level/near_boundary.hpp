// SPDX-License-Identifier: BSD-3-Clause
// The boundary near nodes: who of them sees whom, and how inner ones keep off it.
//
// NearBoundary<2> and NearBoundary<3> have in common:
// - NearLeaves near_leaves(tree, radius): once per tree, what is near its leaves; adopt() takes it,
// - reset(ground): another boundary,
// - build(nodes, at, buckets, map, ground): at every rebuild of the lists, what is within
//   radius() * d_i of each node, the nodes being at `at`,
// - visibility(nodes, map, ground): what AdjacencyList::build asks; in space it is kept of which
//   nodes others are hidden,
// - within(i, reach): does the boundary come nearer to node i than this, if that is no more than
//   radius() * d_i?
// - constrains(nodes, i, reach): may it be in the way of node i, if steps lead no farther?
// - hold_off(i, nodes, map, ground, to): where node i may go that wants to go to `to`; a node on a
//   surface is on the facet there from then on.
#pragma once

#include "level/plane/near_boundary.hpp"
#include "level/volume/near_boundary.hpp"
