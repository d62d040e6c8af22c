// SPDX-License-Identifier: BSD-3-Clause
#include "tool/grid_slope.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <vector>

#include "base/space_vectors.hpp"
#include "sphere/degrees.hpp"

namespace pnpbs::tool {

namespace {

using Directions = std::array<Point<3>, 3>;

Directions axes() { return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}; }

// East and north at a place.
Directions along_sphere(const Point<3>& x) {
  const Point<3> east = east_at(x);
  return {{east, cross(unit_vector(x), east), {}}};
}

// Small against any cell, large against what is lost to rounding in a difference: this part of the
// sphere's radius or of the grid's longest side.
constexpr double kStep = 1e-7;

double longest_side(const Box<3>& box) {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    if (const double side = box.high[k] - box.low[k]; std::isfinite(side))
      longest = std::max(longest, side);
  return longest > 0 ? longest : 1;
}

}  // namespace

std::string slope_name(const std::string& grid) { return grid + "_slope"; }

bool asks_for_slope(const std::string& formula, const std::string& grid) {
  const std::string name = slope_name(grid);
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
  const auto each = static_cast<std::size_t>(dimension);
  const std::size_t ways = on_sphere ? 2 : each, count = static_cast<std::size_t>(n);
  const double side_of_grid = longest_side(grid.extent());
  std::vector<double> places, steps;
  for (std::size_t i = 0; i < count; ++i) {
    Point<3> x{};
    std::copy_n(coordinates + each * i, each, x.begin());
    const Directions directions = on_sphere ? along_sphere(x) : axes();
    steps.push_back(kStep * (on_sphere ? length(x) : side_of_grid));
    for (std::size_t k = 0; k < ways; ++k)
      for (const double side : {-1.0, 1.0}) {
        const Point<3> beside = shifted(x, side * steps.back(), directions[k]);
        places.insert(places.end(), beside.begin(), beside.begin() + dimension);
      }
  }
  std::vector<double> values(2 * ways * count);
  grid.evaluate(static_cast<std::int64_t>(values.size()), places.data(), values.data(), nullptr);
  for (std::size_t i = 0; i < count; ++i) {
    double square = 0;
    for (std::size_t k = 0; k < ways; ++k) {
      const double* pair = &values[2 * (ways * i + k)];
      const double change = (pair[1] - pair[0]) / (2 * steps[i]);
      square += change * change;
    }
    slopes[i] = std::sqrt(square);
  }
}

}  // namespace pnpbs::tool
