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
template <int Dim, int In>
typename KnownValues<In>::Slope slope_of(const Patch<Dim, In>& patch,
                                         const std::array<std::int32_t, Dim + 1>& simplex) {
  constexpr std::size_t kCorners = Dim + 1;
  const auto node = [&](std::size_t k) -> const PatchNode<In>& {
    return patch.nodes[static_cast<std::size_t>(simplex[k])];
  };
  typename KnownValues<In>::Slope slope{0, node(0).value, {}};
  std::array<Point<In>, kCorners - 1> edges;
  std::array<double, kCorners - 1> rises, squares;
  double square_of_growth = 0;
  for (std::size_t k = 0; k + 1 < kCorners; ++k) {
    rises[k] = node(k + 1).value - node(0).value;
    for (std::size_t c = 0; c < In; ++c) edges[k][c] = node(k + 1).x[c] - node(0).x[c];
    for (std::size_t before = 0; before < k; ++before) {
      double along = 0;
      for (std::size_t c = 0; c < In; ++c) along += edges[k][c] * edges[before][c];
      along /= squares[before];
      for (std::size_t c = 0; c < In; ++c) edges[k][c] -= along * edges[before][c];
      rises[k] -= along * rises[before];
    }
    squares[k] = 0;
    for (const double e : edges[k]) squares[k] += e * e;
    // Of a simplex that is flat but for rounding, nothing may be left.
    if (squares[k] > 0) square_of_growth += rises[k] * rises[k] / squares[k];
    squares[k] = std::max(squares[k], std::numeric_limits<double>::min());
  }
  slope.growth = std::sqrt(square_of_growth);
  for (std::size_t k = 0; k < kCorners; ++k) {
    slope.d = std::min(slope.d, node(k).value);
    for (std::size_t c = 0; c < In; ++c) slope.at[c] += node(k).x[c] / kCorners;
  }
  return slope;
}

}  // namespace pnpbs
