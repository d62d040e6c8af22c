// SPDX-License-Identifier: BSD-3-Clause
#include "domain/volume/node_distance.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "base/space_vectors.hpp"
#include "domain/volume/crease_nodes.hpp"
#include "domain/volume/features.hpp"
#include "implicit/level_set.hpp"

namespace pnpbs {

namespace {

constexpr std::size_t kPointsAtOnce = 1 << 14;  // points that f is asked for at a time

// to(k): where from[k] is put.
template <class To>
double largest_distance(const std::vector<Point<3>>& from, const To& to) {
  double largest = 0;
  for (std::size_t k = 0; k < from.size(); ++k)
    largest = std::max(largest, distance<3>(from[k], to(k)));
  return largest;
}

// Of these points, which are cleared.
double distance_to_zero(const LevelSet& set, std::vector<Point<3>>& points) {
  const std::vector<Point<3>> before = points;
  set.project(points, set.resolution());
  const double largest = largest_distance(before, [&](std::size_t k) { return points[k]; });
  points.clear();
  return largest;
}

// In the middle of each triangle and of its sides.
double distance_to_triangles(const ResolvedVolume& volume, const LevelSet& set) {
  const BoundaryMesh<3>& mesh = volume.mesh;
  std::vector<Point<3>> points;
  double largest = 0;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    if (volume.level_sets.at(static_cast<std::int32_t>(f)) != &set) continue;
    const auto [a, b, c] = corners_of(mesh, mesh.facets[f]);
    for (const Point<3>& x : {halfway(a, b), halfway(b, c), halfway(c, a),
                              shifted(halfway(a, b), 1.0 / 3, difference(c, halfway(a, b)))})
      points.push_back(x);
    if (points.size() >= kPointsAtOnce) largest = std::max(largest, distance_to_zero(set, points));
  }
  return std::max(largest, distance_to_zero(set, points));
}

// In the middle of each feature edge.
double distance_to_creases(const ResolvedVolume& volume) {
  const Features& features = volume.features;
  FeatureNodes middles;
  std::vector<Point<3>> before;
  for (std::size_t c = 0; c < features.curves.size(); ++c) {
    const FeatureCurve& curve = features.curves[c];
    for (std::size_t e = 0; e < curve.edge_count(); ++e) {
      const auto at = [&](std::size_t k) {
        return volume.mesh.nodes[static_cast<std::size_t>(curve.nodes[k])].position;
      };
      before.push_back(halfway(at(e), at(e + 1)));
      middles.nodes.push_back({before.back(), 0, -1, static_cast<std::int32_t>(c),
                               curve.first_edge + static_cast<std::int32_t>(e)});
    }
  }
  put_on_creases(volume, middles, std::numeric_limits<double>::infinity());
  return largest_distance(before, [&](std::size_t k) { return middles.nodes[k].position; });
}

}  // namespace

double largest_node_distance(const ResolvedVolume& volume) {
  constexpr double kSpare = 2, kLeast = 1e-6;  // the latter in units of the resolution
  double resolution = 0, largest = 0;
  for (const auto& set : volume.level_sets.sets) {
    if (!set) continue;
    resolution = std::max(resolution, set->resolution());
    largest = std::max(largest, distance_to_triangles(volume, *set));
  }
  if (resolution > 0) largest = std::max(largest, distance_to_creases(volume));
  return std::clamp(kSpare * largest, kLeast * resolution, resolution);
}

}  // namespace pnpbs
