// SPDX-License-Identifier: BSD-3-Clause
// Places nodes on the features of surfaces: one on each corner, and between corners at equal steps
// of the integral of ds/d along the polyline through the mesh's nodes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/types.hpp"
#include "domain/node_limit.hpp"
#include "domain/spacing_evaluator.hpp"
#include "domain/volume/features.hpp"
#include "domain/volume/volume_domain.hpp"
#include "geometry/boundary_mesh.hpp"

namespace pnpbs {

// A node on a corner or on a feature curve.
struct FeatureNode {
  Point<3> position;
  std::int32_t tag;
  std::int32_t corner;  // index into Features::corners, or -1
  std::int32_t curve;   // index into Features::curves, or -1
  std::int32_t edge;    // index of its feature edge, or -1
};

// All nodes on features.
struct FeatureNodes {
  std::vector<FeatureNode> nodes;  // corners first, in their order, then curve by curve
  // The nodes of each curve in order, with the corners at its ends. In a closed curve the last node
  // is the first.
  std::vector<std::vector<std::int32_t>> along;

  // Returns the node that follows `node` in the given direction of its curve, or of a curve that
  // ends at its corner.
  std::int32_t next(std::int32_t node, const CurveDirection& way) const;
  // Returns true if the two nodes are consecutive on a curve.
  bool joined(std::int32_t a, std::int32_t b) const;
};

// Places n = max(1, round(integral)) steps on each curve, and at least 3 on closed ones. Evaluates
// d on the curves and at a few points of the largest triangles. Throws Error(ErrorKind::spacing) or
// Error(ErrorKind::memory) if the limit does not allow that many nodes.
FeatureNodes place_feature_nodes(const BoundaryMesh<3>& mesh, const Features& features,
                                 const SpacingEvaluator<3>& spacing,
                                 const NodeLimit& limit = (std::int64_t{1} << 31) - 2);

// Returns the nodes halfway between consecutive ones: along[c][k] is between the nodes k and k + 1
// of curve c of `laid`.
FeatureNodes middles_between(const BoundaryMesh<3>& mesh, const Features& features,
                             const FeatureNodes& laid);

// Moves nodes on the feature curves of level sets from the chords between mesh vertices to the true
// edges of the level set. A node stays if no edge is found within `reach`.
void project_to_creases(const ResolvedVolume& volume, FeatureNodes& laid, double reach);

// Returns the unit gradients of f on both sides of a node on an edge of a level set; zeros for
// other nodes.
std::array<Point<3>, 2> normals_beside(const ResolvedVolume& volume, const FeatureNode& node);

}  // namespace pnpbs
