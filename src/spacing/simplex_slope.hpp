// SPDX-License-Identifier: BSD-3-Clause
// How steep a spacing is on a simplex, or on a part of a surface in space.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "spacing/nodal_patch.hpp"
#include "spacing/spacing.hpp"

namespace pnpbs {

// The gradient of what is linear on a simplex: by edges that are made orthogonal, one by one, to
// those before. What is left of the values along them are its components.
template <int Dim, std::size_t Corners>
typename KnownValues<Dim>::Slope slope_of(const Patch<Dim>& patch,
                                          const std::array<std::int32_t, Corners>& simplex) {
  const auto node = [&](std::size_t k) -> const PatchNode<Dim>& {
    return patch.nodes[static_cast<std::size_t>(simplex[k])];
  };
  typename KnownValues<Dim>::Slope slope{0, node(0).value, {}};
  std::array<Point<Dim>, Corners - 1> edges;
  std::array<double, Corners - 1> rises, squares;
  double square_of_growth = 0;
  for (std::size_t k = 0; k + 1 < Corners; ++k) {
    rises[k] = node(k + 1).value - node(0).value;
    for (std::size_t c = 0; c < Dim; ++c) edges[k][c] = node(k + 1).x[c] - node(0).x[c];
    for (std::size_t before = 0; before < k; ++before) {
      double along = 0;
      for (std::size_t c = 0; c < Dim; ++c) along += edges[k][c] * edges[before][c];
      along /= squares[before];
      for (std::size_t c = 0; c < Dim; ++c) edges[k][c] -= along * edges[before][c];
      rises[k] -= along * rises[before];
    }
    squares[k] = 0;
    for (const double e : edges[k]) squares[k] += e * e;
    // Of a simplex that is flat but for rounding, nothing may be left.
    if (squares[k] > 0) square_of_growth += rises[k] * rises[k] / squares[k];
    squares[k] = std::max(squares[k], std::numeric_limits<double>::min());
  }
  slope.growth = std::sqrt(square_of_growth);
  for (std::size_t k = 0; k < Corners; ++k) {
    slope.d = std::min(slope.d, node(k).value);
    for (std::size_t c = 0; c < Dim; ++c) slope.at[c] += node(k).x[c] / Corners;
  }
  return slope;
}

}  // namespace pnpbs
