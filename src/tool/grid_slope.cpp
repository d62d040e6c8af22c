// SPDX-License-Identifier: BSD-3-Clause
#include "tool/grid_slope.hpp"

#include "sphere/slopes.hpp"

namespace pnpbs::tool {

std::string slope_name(const std::string& grid) { return grid + "_slope"; }

void evaluate_slope(const NamedGrid& grid, int dimension, bool on_sphere, std::int64_t n,
                    const double* coordinates, double* slopes) {
  const auto values = [&](std::int64_t count, const double* places, double* there) {
    grid.evaluate(count, places, there, nullptr);
  };
  slopes_of(values, dimension, on_sphere, longest_finite_side(grid.extent()), n, coordinates,
            slopes);
}

}  // namespace pnpbs::tool
