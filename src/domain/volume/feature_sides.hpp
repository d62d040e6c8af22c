// SPDX-License-Identifier: BSD-3-Clause
// The sides of feature edges and the sectors around corners.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "domain/volume/features.hpp"

namespace pnpbs {

// What of a patch lies around a place: all of it (of a facet), one side of a feature edge, or the
// sector at a corner between two of them.
struct SurfaceSide {
  std::int32_t patch;
  Point<3> normal;  // unit
  // Counter-clockwise, as seen from where the normal points to, the side reaches from this
  // direction of a curve to that one; curve -1: all around.
  CurveDirection begin, end;
};

// In the order of edges or corners; those of the n-th are begin[n] to begin[n + 1] - 1.
struct FeatureSides {
  std::vector<std::size_t> begin{0};
  std::vector<SurfaceSide> sides;

  std::span<const SurfaceSide> of(std::int32_t n) const {
    const auto at = begin.begin() + n;
    return {sides.data() + at[0], sides.data() + at[1]};
  }
};

// One for each facet at each feature edge.
FeatureSides sides_of_edges(const BoundaryMesh<3>& mesh, const Features& features,
                            std::span<const Point<3>> normals);

// One for each fan of facets between feature edges; its normal is the mean by the facets' angles.
FeatureSides sides_of_corners(const BoundaryMesh<3>& mesh, const Features& features,
                              std::span<const Point<3>> normals);

}  // namespace pnpbs
