// SPDX-License-Identifier: BSD-3-Clause
#include "tool/grid_slope.hpp"

#include <cctype>

#include "sphere/slopes.hpp"

namespace pnpbs::tool {

std::string slope_name(const std::string& grid) { return grid + "_slope"; }

bool mentions(const std::string& formula, const std::string& name) {
  const auto is_part = [&](std::size_t at) {
    const auto c = static_cast<unsigned char>(at < formula.size() ? formula[at] : ' ');
    return std::isalnum(c) != 0 || c == '_';
  };
  for (std::size_t at = formula.find(name); at != std::string::npos;
       at = formula.find(name, at + 1))
    if (!(at > 0 && is_part(at - 1)) && !is_part(at + name.size())) return true;
  return false;
}

void evaluate_slope(const NamedGrid& grid, int dimension, bool on_sphere, std::int64_t n,
                    const double* coordinates, double* slopes) {
  const auto values = [&](std::int64_t count, const double* places, double* there) {
    grid.evaluate(count, places, there, nullptr);
  };
  slopes_of(values, dimension, on_sphere, longest_finite_side(grid.extent()), n, coordinates,
            slopes);
}

}  // namespace pnpbs::tool
