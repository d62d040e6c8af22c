// SPDX-License-Identifier: BSD-3-Clause
// When nodes of a level travel between ranks. With one rank nothing happens.
#pragma once

#include <exception>

#include "initial/incoming_nodes.hpp"
#include "level/level.hpp"

namespace pnpbs {

// Owned nodes to their owners, and ghosts chosen anew, so many hops deep. Where ranks can agree: on
// the halo before it, which a first use has to find, and that it went well.
template <int Dim>
void exchange(Level<Dim>& level, int hops);
// For the steps until the next exchange: at the beginning of a row of steps, and once in a while
// within it. Between agreements only positions and velocities travel, in buffers that are there: a
// rank that has failed meanwhile sends what it has, and keeps a failure of the messages for the
// next agreement. Where ranks agree a failure of this rank so far is reported.
template <int Dim>
void exchange_for_steps(Level<Dim>& level, std::exception_ptr& failure);
// The ghosts there are become exact again. Collective, with an agreement at the beginning; throws
// on a rank that lacks values of its ghosts.
template <int Dim>
void update_ghosts(Level<Dim>& level);

// Every node to the rank that owns its place, from wherever it is; most are there already.
template <int Dim>
void scatter_to_owners(const Level<Dim>& level, IncomingNodes<Dim>& incoming);

}  // namespace pnpbs
