// SPDX-License-Identifier: BSD-3-Clause
// One time step of a level: lists where they are needed anew, forces and motion.
#pragma once

#include <exception>

#include "level/level.hpp"

namespace pnpbs {

// On this rank; its failure waits in `failure` until ranks agree, and until then nothing more is
// done. The step counts, done or not: all ranks must count alike.
template <int Dim>
void step(Level<Dim>& level, std::exception_ptr& failure);
// The last one by the classical Runge-Kutta scheme, whose stages look ahead: exchange, lists and
// step. Collective.
template <int Dim>
void finish_by_runge_kutta(Level<Dim>& level);

}  // namespace pnpbs
