// SPDX-License-Identifier: BSD-3-Clause
// Nodes on the features of surfaces: a node on each corner, and between corners equal steps of the
// integral of ds/d along the polyline through the mesh's nodes.
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

struct FeatureNode {
  Point<3> position;
  std::int32_t tag;
  std::int32_t corner;  // index into Features::corners, or -1
  std::int32_t curve;   // index into Features::curves, or -1
  std::int32_t edge;    // the feature edge of that curve on which it lies, or -1
};

struct FeatureNodes {
  std::vector<FeatureNode> nodes;  // corners first, in their order, then curve by curve
  // Of each curve its nodes in a row, the corners at its ends included; of a closed one the last is
  // the first again.
  std::vector<std::vector<std::int32_t>> along;

  // The one after a node in a direction of its curve, or of one that ends at its corner.
  std::int32_t next(std::int32_t node, const CurveDirection& way) const;
  // Are two nodes next to each other on a curve?
  bool joined(std::int32_t a, std::int32_t b) const;
};

// n = max(1, round(integral)) steps on each curve, 3 at least on closed ones. d is asked on the
// curves, and at a few places on the largest triangles. Throws Error(ErrorKind::spacing) or
// ::memory if there, or on the curves, would be more nodes than the limit allows.
FeatureNodes lay_feature_nodes(const BoundaryMesh<3>& mesh, const Features& features,
                               const SpacingEvaluator<3>& spacing,
                               const NodeLimit& limit = (std::int64_t{1} << 31) - 2);

// Moves the nodes between corners of a level set to where its edges truly run, not on the chords
// between the vertices of their triangles; a node for which no edge is found within reach stays.
void put_on_creases(const ResolvedVolume& volume, FeatureNodes& laid, double reach);

// The gradients of f beside a node on its edge, of length 1; 0 for other nodes.
std::array<Point<3>, 2> normals_beside(const ResolvedVolume& volume, const FeatureNode& node);

}  // namespace pnpbs
