// SPDX-License-Identifier: BSD-3-Clause
// How nodes on their way into a level are sorted, numbered and stored.
#pragma once

#include <cstdint>
#include <vector>

#include "initial/incoming_nodes.hpp"
#include "level/boundary_nodes.hpp"
#include "level/level.hpp"

namespace pnpbs {

// Of inner nodes; a boundary node has none, it is laid afresh.
template <int Dim>
void find_leaves(const Level<Dim>& level, IncomingNodes<Dim>& incoming);
// By leaf, in Morton order, and by place within it, so that nothing depends on where nodes came
// from; those that have no leaf are left out. Returns the first place of each leaf.
template <int Dim>
std::vector<std::int32_t> sort_by_place(const Level<Dim>& level, IncomingNodes<Dim>& incoming);
// Nodes that are numbered from now on get ids larger than these have. Collective.
template <int Dim>
void reserve_ids(Level<Dim>& level, const IncomingNodes<Dim>& incoming);
// The boundary nodes of this rank and these inner ones, sorted by place, become the nodes of the
// level. Those without an id get new ones. Collective.
template <int Dim>
void number_and_store(Level<Dim>& level, IncomingNodes<Dim> inner, BoundaryNodes<Dim> laid);

}  // namespace pnpbs
