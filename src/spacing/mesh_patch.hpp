// SPDX-License-Identifier: BSD-3-Clause
// Conversion of a complete background mesh to a Patch, and the spacing hints of a patch.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "spacing/given_field.hpp"
#include "spacing/nodal_patch.hpp"
#include "spacing/spacing.hpp"

namespace pnpbs {

// Returns the growth of d on a simplex: the length of the gradient of the linear interpolant, which
// may live on a surface in space. The edges are orthogonalised one by one (Gram-Schmidt); the
// remaining differences of the values are the components of the gradient.
template <int Dim, int In>
typename SpacingHints<In>::Slope slope_of(const Patch<Dim, In>& patch,
                                          const std::array<std::int32_t, Dim + 1>& simplex) {
  constexpr std::size_t kCorners = Dim + 1;
  const auto node = [&](std::size_t k) -> const PatchNode<In>& {
    return patch.nodes[static_cast<std::size_t>(simplex[k])];
  };
  typename SpacingHints<In>::Slope slope{0, node(0).value, {}};
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
    // A nearly flat simplex may have no remaining edge.
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

// Returns the facets that belong to one simplex only. If neighbours do not share whole facets, the
// result also has facets inside the mesh. These are harmless, as they are nearest to no point
// outside the mesh.
template <int Dim>
std::vector<std::array<std::int32_t, Dim>> open_facets(
    const std::vector<std::array<std::int32_t, Dim + 1>>& simplices) {
  std::vector<std::array<std::int32_t, Dim>> facets;
  facets.reserve(simplices.size() * (Dim + 1));
  for (const auto& simplex : simplices)
    for (std::size_t without = 0; without <= Dim; ++without) {
      std::array<std::int32_t, Dim> facet;
      std::copy_n(simplex.begin(), without, facet.begin());
      std::copy(simplex.begin() + static_cast<std::ptrdiff_t>(without) + 1, simplex.end(),
                facet.begin() + static_cast<std::ptrdiff_t>(without));
      facets.push_back(facet);
    }
  std::sort(facets.begin(), facets.end());
  std::vector<std::array<std::int32_t, Dim>> open;
  for (auto facet = facets.begin(); facet != facets.end();) {
    const auto next = std::find_if(facet, facets.end(), [&](const auto& f) { return f != *facet; });
    if (next - facet == 1) open.push_back(*facet);
    facet = next;
  }
  return open;
}

// Builds a patch from a mesh. Duplicate simplices are merged.
template <int Dim, int In>
Patch<Dim, In> patch_of_mesh(const GivenField<In, Dim + 1>& field) {
  Patch<Dim, In> patch;
  patch.nodes.reserve(field.points.size());
  for (std::size_t i = 0; i < field.points.size(); ++i)
    patch.nodes.push_back({field.points[i], static_cast<std::int64_t>(i), field.values[i]});
  auto simplices = field.elements;
  for (auto& simplex : simplices) std::sort(simplex.begin(), simplex.end());
  std::sort(simplices.begin(), simplices.end());
  simplices.erase(std::unique(simplices.begin(), simplices.end()), simplices.end());
  patch.border = open_facets<Dim>(simplices);
  patch.simplices = std::move(simplices);
  return patch;
}

// Returns the values at the nodes of simplices and the slopes of all simplices as hints.
template <int Dim, int In>
SpacingHints<In> spacing_hints_of(const Patch<Dim, In>& patch) {
  SpacingHints<In> known;
  std::vector<bool> used(patch.nodes.size(), false);
  for (const auto& simplex : patch.simplices) {
    for (const std::int32_t i : simplex) used[static_cast<std::size_t>(i)] = true;
    known.slopes.push_back(slope_of(patch, simplex));
  }
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) known.values.push_back({patch.nodes[i].x, patch.nodes[i].value});
  return known;
}

}  // namespace pnpbs
