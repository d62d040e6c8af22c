// SPDX-License-Identifier: BSD-3-Clause
// Slopes of a field in the plane, in space or along a sphere by central differences.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/space_vectors.hpp"
#include "sphere/degrees.hpp"

namespace pnpbs {

// Step of the central differences, relative to the radius of the sphere or to the longest side of
// the field. It is small compared to any grid cell and large compared to rounding errors.
inline constexpr double kSlopeStep = 1e-7;

using FieldValues = std::function<void(std::int64_t n, const double* coordinates, double* values)>;

inline double longest_finite_side(const Box<3>& box) {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    if (const double side = box.high[k] - box.low[k]; std::isfinite(side))
      longest = std::max(longest, side);
  return longest > 0 ? longest : 1;
}

// Returns the directions of differentiation at x: the axes, or east and north on a sphere about the
// origin.
inline std::array<Point<3>, 3> directions_of_slopes(const Point<3>& x, bool on_sphere) {
  if (!on_sphere) return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const Point<3> east = east_at(x);
  return {{east, cross(unit_vector(x), east), {}}};
}

// Writes the norm of the gradient of `field` at each of n points to `slopes`. `side` is the longest
// side of the field and is not used on a sphere.
inline void slopes_of(const FieldValues& field, int dimension, bool on_sphere, double side,
                      std::int64_t n, const double* coordinates, double* slopes) {
  const auto each = static_cast<std::size_t>(dimension);
  const std::size_t ways = on_sphere ? 2 : each, count = static_cast<std::size_t>(n);
  std::vector<double> places, steps;
  for (std::size_t i = 0; i < count; ++i) {
    Point<3> x{};
    std::copy_n(coordinates + each * i, each, x.begin());
    const std::array<Point<3>, 3> directions = directions_of_slopes(x, on_sphere);
    steps.push_back(kSlopeStep * (on_sphere ? length(x) : side));
    for (std::size_t k = 0; k < ways; ++k)
      for (const double way : {-1.0, 1.0}) {
        const Point<3> beside = shifted(x, way * steps.back(), directions[k]);
        places.insert(places.end(), beside.begin(), beside.begin() + dimension);
      }
  }
  std::vector<double> values(2 * ways * count);
  field(static_cast<std::int64_t>(values.size()), places.data(), values.data());
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

}  // namespace pnpbs
