// SPDX-License-Identifier: BSD-3-Clause
// Sample points of a triangle for distance measurements.
#pragma once

#include <array>

#include "base/types.hpp"

namespace pnpbs {

// Returns the centroid of the triangle and the middles of its sides.
inline std::array<Point<3>, 4> triangle_samples(const std::array<Point<3>, 3>& corners) {
  constexpr double kWeights[][3] = {
      {1. / 3, 1. / 3, 1. / 3}, {.5, .5, 0}, {0, .5, .5}, {.5, 0, .5}};
  std::array<Point<3>, 4> samples{};
  for (std::size_t s = 0; s < samples.size(); ++s)
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (std::size_t k = 0; k < 3; ++k) samples[s][k] += kWeights[s][corner] * corners[corner][k];
  return samples;
}

}  // namespace pnpbs
