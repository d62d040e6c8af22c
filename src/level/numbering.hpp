// SPDX-License-Identifier: BSD-3-Clause
// The sorting, numbering and storing of nodes that enter a level.
#pragma once

#include <cstdint>
#include <vector>

#include "initial/incoming_nodes.hpp"
#include "level/boundary_nodes.hpp"
#include "level/level.hpp"

namespace pnpbs {

// Sets the leaves of inner nodes. Boundary nodes get -1.
template <int Dim>
void find_leaves(const Level<Dim>& level, IncomingNodes<Dim>& incoming);
// Sorts the nodes by leaf, in Morton order, and then by position, so that the order does not depend
// on where they came from. Removes nodes without a leaf. Returns the index of the first node of
// each leaf.
template <int Dim>
std::vector<std::int32_t> sort_by_leaf(const Level<Dim>& level, IncomingNodes<Dim>& incoming);
// Makes level.next_id larger than all ids of these nodes. Collective.
template <int Dim>
void reserve_ids(Level<Dim>& level, const IncomingNodes<Dim>& incoming);
// Stores these boundary nodes and inner nodes, sorted by sort_by_leaf(), as the nodes of the
// level. Nodes without an id get new ones. All ranks must call it, and if one rank throws, all
// ranks throw.
template <int Dim>
void number_and_store(Level<Dim>& level, IncomingNodes<Dim> inner, BoundaryNodes<Dim> laid);

}  // namespace pnpbs
