// SPDX-License-Identifier: BSD-3-Clause
// Facets cut into pieces about as wide as d, so that d is known all over a surface.
#pragma once

#include <cstdint>
#include <vector>

#include "domain/node_limit.hpp"
#include "domain/spacing_evaluator.hpp"
#include "domain/volume/surface.hpp"

namespace pnpbs {

struct SurfacePiece {
  SurfacePoint centre;
  double area;
  double d;  // at the centre
};

// Of each patch, in the Morton order of their centres. d is asked at the centres, in batches. A
// piece has room for less than one node. Throws Error(ErrorKind::spacing) if there would be more
// nodes than the limit allows.
std::vector<std::vector<SurfacePiece>> cut_to_pieces(const Surface& surface,
                                                     const SpacingEvaluator<3>& spacing,
                                                     const NodeLimit& limit);

}  // namespace pnpbs
