// SPDX-License-Identifier: BSD-3-Clause
// The sides of feature edges and the sectors of patches around corners.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "domain/volume/features.hpp"

namespace pnpbs {

// The part of a patch around a point: all of it (on a facet), one side of a feature edge, or the
// sector between two feature edges at a corner.
struct SurfaceSide {
  std::int32_t patch;
  Point<3> normal;  // unit
  // The curve directions between which the part extends, counter-clockwise as seen from the tip of
  // the normal. Curve -1 means all around.
  CurveDirection begin, end;
};

// Sides of all feature edges, or sectors of all corners, in their order. Item n has the sides
// with indices begin[n] to begin[n + 1] - 1.
struct FeatureSides {
  std::vector<std::size_t> begin{0};
  std::vector<SurfaceSide> sides;

  std::span<const SurfaceSide> of(std::int32_t n) const {
    const auto at = begin.begin() + n;
    return {sides.data() + at[0], sides.data() + at[1]};
  }
};

// Returns one side for each facet at each feature edge. `normals` has the unit normals of the
// facets.
FeatureSides sides_of_edges(const BoundaryMesh<3>& mesh, const Features& features,
                            std::span<const Point<3>> normals);

// Returns one sector for each fan of facets between feature edges. Its normal is the mean of the
// facets' normals, weighted by their angles at the corner.
FeatureSides sides_of_corners(const BoundaryMesh<3>& mesh, const Features& features,
                              std::span<const Point<3>> normals);

}  // namespace pnpbs
