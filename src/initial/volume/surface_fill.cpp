// SPDX-License-Identifier: BSD-3-Clause
#include "initial/volume/surface_fill.hpp"

#include <algorithm>
#include <cmath>

#include "base/lattice.hpp"
#include "initial/initial_fill.hpp"
#include "initial/volume/flat_lattice.hpp"
#include "initial/volume/surface_pieces.hpp"

namespace pnpbs {

namespace {

// Fewer nodes make no closed triangulation.
constexpr double kMinClosed = 4;

double wanted_nodes(const SurfacePiece& piece) {
  return Lattice<2>::kDensity * piece.area / (piece.d * piece.d);
}

SpacingSummary<2> summary(const std::vector<SurfacePiece>& pieces) {
  SpacingSummary<2> whole;
  for (const SurfacePiece& piece : pieces)
    whole.add({piece.d, piece.d, piece.area, piece.area / (piece.d * piece.d)});
  return whole;
}

void add_running_sum(const Surface& surface, const std::vector<SurfacePiece>& pieces, bool closed,
                     std::vector<SurfacePoint>& nodes) {
  double wanted = 0;
  for (const SurfacePiece& piece : pieces) wanted += wanted_nodes(piece);
  const double scale = closed && wanted > 0 ? std::max(1.0, kMinClosed / wanted) : 1;
  double sum = 0.5, next = 1;
  for (const SurfacePiece& piece : pieces) {
    sum += scale * wanted_nodes(piece);
    if (sum < next) continue;
    ++next;
    const double clearance = kFillClearance * piece.d;
    if (surface.feature_clearance(piece.centre, clearance) >= clearance)
      nodes.push_back(piece.centre);
  }
}

}  // namespace

std::vector<SurfacePoint> surface_fill(const Surface& surface, const SpacingEvaluator<3>& spacing,
                                       const NodeLimit& limit) {
  const std::vector<std::vector<SurfacePiece>> pieces = cut_to_pieces(surface, spacing, limit);
  const Features& features = surface.features();
  std::vector<std::vector<std::int32_t>> facets(pieces.size());
  for (std::size_t f = 0; f < features.patch.size(); ++f)
    if (features.patch[f] >= 0)
      facets[static_cast<std::size_t>(features.patch[f])].push_back(static_cast<std::int32_t>(f));
  std::vector<SurfacePoint> nodes;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const auto patch = static_cast<std::int32_t>(p);
    const SpacingSummary<2> whole = summary(pieces[p]);
    if (surface.is_flat(patch) && whole.max <= kPatchVariation * whole.min) {
      const std::vector<SurfacePoint> lattice =
          flat_lattice(surface, patch, facets[p], whole.spacing(), kFillClearance);
      nodes.insert(nodes.end(), lattice.begin(), lattice.end());
    } else {
      add_running_sum(surface, pieces[p], !surface.has_features(patch), nodes);
    }
  }
  return nodes;
}

}  // namespace pnpbs
