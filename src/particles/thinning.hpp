// SPDX-License-Identifier: BSD-3-Clause
// Leaves out particles that are too close to others.
#pragma once

#include "comm/communicator.hpp"
#include "particles/known_particles.hpp"

namespace pnpbs {

// Afterwards no two that are kept are less than least * (d_i + d_j) / 2 apart, and each that is
// left out is that close to one that is kept. Those with the fewest others so close are kept first,
// of several with as many the one with the lowest id; so it does not matter which rank has which.
// Ghosts must be known as far. Collective, and agreed.
template <int Dim>
void leave_out_close_ones(const Communicator& comm, double least, KnownParticles<Dim>& particles);

extern template void leave_out_close_ones(const Communicator&, double, KnownParticles<2>&);
extern template void leave_out_close_ones(const Communicator&, double, KnownParticles<3>&);

}  // namespace pnpbs
