// SPDX-License-Identifier: BSD-3-Clause
// Helper functions that all node sources share.
#pragma once

#include <array>

#include "io/node_source.hpp"
#include "results/results.hpp"

namespace pnpbs::io {

// Number of nodes of one rank in a window. It is large enough for efficient messages and writes,
// and small compared with the nodes of a rank.
constexpr std::int64_t kWindow = 8192;

// Returns the quality, 2 r_in / R of a triangle and 3 r_in / R of a tetrahedron. It is 1 for
// regular and 0 for flat ones.
inline float quality_of(const std::array<Point<2>, 2>&) { return 0; }  // edges have no quality
float quality_of(const std::array<Point<2>, 3>& triangle);
float quality_of(const std::array<Point<3>, 3>& triangle);
float quality_of(const std::array<Point<3>, 4>& tetrahedron);

// Returns the positions of nodes by their indices in the results, in the coordinates of the level.
template <int Dim, std::size_t n>
std::array<Point<Dim>, n> positions_at(const Results<Dim>& results,
                                       const std::array<std::int64_t, n>& places) {
  std::array<Point<Dim>, n> x;
  for (std::size_t k = 0; k < n; ++k)
    x[k] = results.level().nodes.position(results.node_at(places[k]));
  return x;
}

// Returns the positions in the coordinates of the user, with three components.
template <int Dim, std::size_t n>
std::array<Point<3>, n> places_in_space(const Results<Dim>& results,
                                        const std::array<std::int64_t, n>& places) {
  std::array<Point<3>, n> x;
  for (std::size_t k = 0; k < n; ++k) x[k] = results.point_in_space(results.node_at(places[k]));
  return x;
}

// Returns the quality of an element, see ElementRows.
template <int Dim, std::size_t n>
float element_quality(const Results<Dim>& results, const std::array<std::int64_t, n>& places) {
  if (results.embedding().is_sphere()) return quality_of(places_in_space(results, places));
  return quality_of(positions_at(results, places));
}

// Returns the quality of a facet, see FacetRows.
template <int Dim, std::size_t n>
float facet_quality(const Results<Dim>& results, const std::array<std::int64_t, n>& places) {
  return quality_of(positions_at(results, places));
}

template <int Dim>
Cells cells_of(const Results<Dim>& results, bool elements) {
  if (!elements) return Cells::nodes;
  return results.kind() == GeometryKind::surface ? Cells::facets : Cells::elements;
}

// Prepares the stars if `elements`, else only the order of the nodes. Collective.
void prepare(NodalResults& results, bool elements);

}  // namespace pnpbs::io
