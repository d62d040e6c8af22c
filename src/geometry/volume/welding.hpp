// SPDX-License-Identifier: BSD-3-Clause
// Points at the same place become one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

// Of each point the one it joins: the nearest point before it within the tolerance that has joined
// none itself, or else itself; points at exactly the same place join the same. In n log n time, as
// long as not too many of them crowd within a thousand tolerances.
std::vector<std::int32_t> weld_points(std::span<const Point<3>> points, double tolerance);

}  // namespace pnpbs
