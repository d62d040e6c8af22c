// SPDX-License-Identifier: BSD-3-Clause
// Steps that all sources of nodes have in common.
#pragma once

#include <array>

#include "io/node_source.hpp"
#include "results/results.hpp"

namespace pnpbs::io {

// Nodes of one rank in a window: large enough that a window's messages and writes are, small
// against the nodes of any rank that has many.
constexpr std::int64_t kWindow = 8192;

// Of a triangle 2 r_in / R, of a tetrahedron 3 r_in / R: 1 for an equilateral one, 0 for a flat
// one.
inline float quality_of(const std::array<Point<2>, 2>&) { return 0; }  // edges have none
float quality_of(const std::array<Point<2>, 3>& triangle);
float quality_of(const std::array<Point<3>, 3>& triangle);
float quality_of(const std::array<Point<3>, 4>& tetrahedron);

// Where the nodes at these places are.
template <int Dim, std::size_t n>
std::array<Point<Dim>, n> positions_at(const Results<Dim>& results,
                                       const std::array<std::int64_t, n>& places) {
  std::array<Point<Dim>, n> x;
  for (std::size_t k = 0; k < n; ++k)
    x[k] = results.level().nodes.position(results.node_at(places[k]));
  return x;
}

// As they are handed out.
template <int Dim, std::size_t n>
std::array<Point<3>, n> places_in_space(const Results<Dim>& results,
                                        const std::array<std::int64_t, n>& places) {
  std::array<Point<3>, n> x;
  for (std::size_t k = 0; k < n; ++k) x[k] = results.place_in_space(results.node_at(places[k]));
  return x;
}

// Of an element, see ElementRows.
template <int Dim, std::size_t n>
float element_quality(const Results<Dim>& results, const std::array<std::int64_t, n>& places) {
  if (results.embedding().is_sphere()) return quality_of(places_in_space(results, places));
  return quality_of(positions_at(results, places));
}

// Of a facet: see FacetRows.
template <int Dim, std::size_t n>
float facet_quality(const Results<Dim>& results, const std::array<std::int64_t, n>& places) {
  return quality_of(positions_at(results, places));
}

template <int Dim>
Cells cells_of(const Results<Dim>& results, bool elements) {
  if (!elements) return Cells::nodes;
  return results.kind() == GeometryKind::surface ? Cells::facets : Cells::elements;
}

// Makes ready what for_elements and for_facets need, or only the order. Collective.
void prepare(NodalResults& results, bool elements);

}  // namespace pnpbs::io
