// SPDX-License-Identifier: BSD-3-Clause
// Pushes particles apart that are too close to each other.
#pragma once

#include "comm/communicator.hpp"
#include "particles/known_particles.hpp"
#include "particles/wall.hpp"

namespace pnpbs {

// Pairs of less than `least` times the mean of their d share what they lack, round by round; none
// of the others moves. No particle moves by more than kFarthestPush * d in all. Ghosts must be
// known as far as `least` and two of these moves. Collective, and agreed.
template <int Dim>
void push_apart(const Communicator& comm, double least, const Wall<Dim>& wall,
                KnownParticles<Dim>& particles);

inline constexpr double kFarthestPush = 0.3;

extern template void push_apart(const Communicator&, double, const Wall<2>&, KnownParticles<2>&);
extern template void push_apart(const Communicator&, double, const Wall<3>&, KnownParticles<3>&);

}  // namespace pnpbs
