// SPDX-License-Identifier: BSD-3-Clause
// Leaves out particles that are too close to others.
#pragma once

#include "comm/communicator.hpp"
#include "particles/known_particles.hpp"

namespace pnpbs {

// Leaves out particles until no two kept ones are closer than least * (d_i + d_j) / 2. Each one
// left out is that close to a kept one. Particles with the fewest others so close are kept first,
// and of equal ones that with the smallest id. Therefore the result does not depend on the
// partition. Ghosts must be known up to that distance. Collective. If one rank throws, all ranks
// throw.
template <int Dim>
void remove_close_particles(const Communicator& comm, double least, KnownParticles<Dim>& particles);

extern template void remove_close_particles(const Communicator&, double, KnownParticles<2>&);
extern template void remove_close_particles(const Communicator&, double, KnownParticles<3>&);

}  // namespace pnpbs
