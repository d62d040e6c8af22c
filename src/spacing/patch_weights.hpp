// SPDX-License-Identifier: BSD-3-Clause
// Computation of PatchWeights for patches with any shape of simplices.
#pragma once

#include <algorithm>
#include <array>
#include <type_traits>

#include "spacing/nodal_patch.hpp"

namespace pnpbs {

// The nodes of the simplex or facet that gave an answer. `simplex` is false if they are those of a
// facet only.
template <int Dim>
struct AnsweringCorners {
  std::array<std::int32_t, Dim + 1> nodes{};
  bool simplex = false;
};

// Returns the nodes of an answer, sorted by id so that rounding is the same everywhere. A facet
// without a known simplex has its first node twice.
template <int Dim, int In>
AnsweringCorners<Dim> answering_corners(const Patch<Dim, In>& patch, std::int32_t row) {
  if (row >= 0) return {patch.simplices[static_cast<std::size_t>(row)], true};
  const auto facet = static_cast<std::size_t>(-1 - row);
  AnsweringCorners<Dim> corners;
  std::copy_n(patch.border[facet].begin(), Dim, corners.nodes.begin());
  corners.simplex = !patch.behind.empty() && patch.behind[facet] >= 0;
  corners.nodes[Dim] = corners.simplex ? patch.behind[facet] : corners.nodes[0];
  if (corners.simplex)
    std::sort(corners.nodes.begin(), corners.nodes.end(), [&](std::int32_t a, std::int32_t b) {
      return patch.nodes[static_cast<std::size_t>(a)].id <
             patch.nodes[static_cast<std::size_t>(b)].id;
    });
  return corners;
}

// Returns the weights for an answer at x. shares_in(nodes) returns the unnormalised barycentric
// coordinates of x in a simplex. along(facet) returns the coordinates of the point of the facet
// nearest to x along the edges from its first corner.
template <int Dim, int In, class Shares, class Along>
PatchWeights<Dim> weights_in(const Patch<Dim, In>& patch, const std::type_identity_t<Point<In>>& x,
                             std::int32_t row, const Shares& shares_in, const Along& along) {
  const AnsweringCorners<Dim> corners = answering_corners(patch, row);
  PatchWeights<Dim> result;
  result.inside = row >= 0;
  result.nodes = corners.nodes;
  // A point at a node has exactly the node's value.
  for (std::size_t k = 0; k <= Dim; ++k)
    if (patch.nodes[static_cast<std::size_t>(result.nodes[k])].x == x) {
      result.weights[k] = 1;
      result.inside = true;
      return result;
    }
  if (corners.simplex) {
    const std::array<double, Dim + 1> shares = shares_in(result.nodes);
    double all = 0;
    for (const double share : shares) all += share;
    for (std::size_t k = 0; k <= Dim; ++k) result.weights[k] = shares[k] / all;
  } else {
    const std::array<double, Dim - 1> parts =
        along(patch.border[static_cast<std::size_t>(-1 - row)]);
    result.weights[0] = 1;
    for (std::size_t k = 1; k < Dim; ++k) {
      result.weights[k] = parts[k - 1];
      result.weights[0] -= parts[k - 1];
    }
  }
  return result;
}

}  // namespace pnpbs
