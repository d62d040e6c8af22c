// SPDX-License-Identifier: BSD-3-Clause
#include "domain/volume/resolved_features.hpp"

#include <algorithm>
#include <string>

#include "base/point_text.hpp"
#include "domain/volume/features.hpp"

namespace pnpbs {

namespace {

void warn_of_short_creases(ResolvedVolume& resolved) {
  const auto& creases = resolved.features.short_creases;
  if (creases.empty()) return;
  const Point<3>& first =
      resolved.mesh.nodes[static_cast<std::size_t>(creases.front()[0])].position;
  resolved.warnings.emplace_back(
      WarningCode::creases_ignored,
      "treated as roughness, not as features: " + std::to_string(creases.size()) +
          " sharp edges in short creases, the first at " + point_text(first),
      std::ssize(creases));
}

}  // namespace

// Between triangles of one level set normals do not count: these turn where they do not resolve a
// bend. Its edges are known by its gradient.
void find_features_of(const std::vector<SurfaceSource>& surfaces, ResolvedVolume& resolved) {
  std::vector<double> angles;
  for (const SurfaceSource& surface : surfaces)
    if (!surface.level_set) angles.push_back(surface.feature_angle);
  if (angles.empty()) angles.push_back(kFeatureAngle);
  const auto [smallest, largest] = std::minmax_element(angles.begin(), angles.end());
  if (*smallest < *largest)
    resolved.warnings.emplace_back(WarningCode::feature_angle,
                                   "the smallest feature_angle, " + number_text(*smallest) +
                                       " degrees, holds for all surfaces",
                                   0, *smallest);
  SmoothSurfaces smooth{resolved.level_sets.of, {}};
  for (const LevelSetCrease& crease : resolved.level_sets.creases)
    smooth.creases.push_back(crease.nodes);
  resolved.features = find_features(resolved.mesh, *smallest, smooth);
  const Features& features = resolved.features;
  resolved.summary.patches = features.patches;
  for (const FeatureCurve& curve : features.curves)
    resolved.summary.feature_edges += static_cast<std::int64_t>(curve.nodes.size()) - 1;
  resolved.summary.corners = static_cast<std::int64_t>(features.corners.size());
  warn_of_short_creases(resolved);
}

}  // namespace pnpbs
