// SPDX-License-Identifier: BSD-3-Clause
// Pushes particles apart that are too close to each other.
#pragma once

#include "comm/communicator.hpp"
#include "particles/known_particles.hpp"
#include "particles/wall.hpp"

namespace pnpbs {

// Moves both particles of each pair closer than `least` times the mean of their d, round by round.
// Other particles do not move. No particle moves by more than kFarthestPush * d in total. Ghosts
// must be known up to `least` plus two of these moves. Collective. If one rank throws, all ranks
// throw.
template <int Dim>
void push_apart(const Communicator& comm, double least, const Wall<Dim>& wall,
                KnownParticles<Dim>& particles);

// Largest total displacement of a particle. [d]
inline constexpr double kFarthestPush = 0.3;

extern template void push_apart(const Communicator&, double, const Wall<2>&, KnownParticles<2>&);
extern template void push_apart(const Communicator&, double, const Wall<3>&, KnownParticles<3>&);

}  // namespace pnpbs
