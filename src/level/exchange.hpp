// SPDX-License-Identifier: BSD-3-Clause
// The exchange of nodes between the ranks of a level. On one rank these functions do nothing.
#pragma once

#include <exception>

#include "initial/incoming_nodes.hpp"
#include "level/level.hpp"

namespace pnpbs {

// Migrates owned nodes to the ranks that own their positions, and selects the ghosts again, to a
// depth of `hops` hops of the leaf graph. All ranks must call it, and if one rank throws, all ranks
// throw.
template <int Dim>
void exchange(Level<Dim>& level, int hops);
// Makes the ghosts exact for the steps until the next exchange. It selects them again if the
// present ones do not suffice; the ranks then agree, and a failure of this rank so far is reported.
// Otherwise only positions and velocities are sent, in buffers that are kept, and nothing is
// agreed. A rank that has failed still sends its values; failures of the messages are stored in
// `failure` until the ranks agree.
template <int Dim>
void exchange_for_steps(Level<Dim>& level, std::exception_ptr& failure);
// Makes the present ghosts exact again. Collective, with an agreement at the beginning. Throws only
// on a rank that lacks values of its ghosts.
template <int Dim>
void update_ghosts(Level<Dim>& level);

// Replaces a node of a periodic domain by its image in the cell.
template <int Dim>
void put_in_cell(const Level<Dim>& level, IncomingNode<Dim>& node) {
  const PeriodicCell<Dim>& cell = level.nodes.cell;
  if (!cell.any()) return;
  const Point<Dim> x = cell.rounded(node.position);
  const Image<Dim> image = cell.image_of(x);
  node.position = cell.seen_from(image, x);
  if constexpr (Dim == 3)
    node.boundary_node = level.geometry.boundary_seen_from(image, node.carrier, node.boundary_node);
}

// Migrates each incoming node to the rank that owns its position. Few nodes change their rank. All
// ranks must call it, and if one rank throws, all ranks throw.
template <int Dim>
void scatter_to_owners(const Level<Dim>& level, IncomingNodes<Dim>& incoming);

}  // namespace pnpbs
