// SPDX-License-Identifier: BSD-3-Clause
// One time step of a level: a rebuild of the lists if they require it, forces, and motion.
#pragma once

#include <exception>

#include "level/level.hpp"

namespace pnpbs {

// Does a step on this rank. A failure is stored in `failure`, and later calls then do nothing until
// the ranks agree. The step counts in any case, because counts must be the same on all ranks.
// Local.
template <int Dim>
void step(Level<Dim>& level, std::exception_ptr& failure);
// Does the last step, by the classical Runge-Kutta scheme, including the exchange and the lists
// that its stages need. All ranks must call it, and if one rank throws, all ranks throw.
template <int Dim>
void finish_by_runge_kutta(Level<Dim>& level);

}  // namespace pnpbs
