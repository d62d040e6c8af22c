// SPDX-License-Identifier: BSD-3-Clause
// How steep the values on a grid are: NAME_slope in formulas.
#pragma once

#include <cstdint>
#include <string>

#include "tool/named_grid.hpp"

namespace pnpbs::tool {

std::string slope_name(const std::string& grid);

// The change of the values per length, along x and y, or along a sphere; in space along z, too.
// Between the middles of cells it is that of the values there, which are linear in each direction.
void evaluate_slope(const NamedGrid& grid, int dimension, bool on_sphere, std::int64_t n,
                    const double* coordinates, double* slopes);

}  // namespace pnpbs::tool
