// SPDX-License-Identifier: BSD-3-Clause
#include "domain/volume/node_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "base/space_vectors.hpp"
#include "domain/volume/crease_nodes.hpp"
#include "domain/volume/features.hpp"
#include "geometry/volume/triangles.hpp"
#include "implicit/level_set.hpp"

namespace pnpbs {

namespace {

constexpr std::size_t kPointsAtOnce = 1 << 14;  // points that f is asked for at a time
// Points that are nearer by the slope of f than this times the farthest are not looked at again.
constexpr double kMayBeFarthest = 0.25;

// to(k): where from[k] is put.
template <class To>
double largest_distance(const std::vector<Point<3>>& from, const To& to) {
  double largest = 0;
  for (std::size_t k = 0; k < from.size(); ++k)
    largest = std::max(largest, distance<3>(from[k], to(k)));
  return largest;
}

// In the middle of each triangle of the set and of each of its sides.
std::vector<Point<3>> middles_of_triangles(const ResolvedVolume& volume, const LevelSet& set) {
  const BoundaryMesh<3>& mesh = volume.mesh;
  std::vector<std::array<std::int32_t, 2>> sides;
  std::vector<Point<3>> points;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    if (volume.level_sets.at(static_cast<std::int32_t>(f)) != &set) continue;
    points.push_back(centroid(corners_of(mesh, mesh.facets[f])));
    const std::array<std::int32_t, 3>& nodes = mesh.facets[f].nodes;
    for (std::size_t k = 0; k < 3; ++k)
      sides.push_back(
          {std::min(nodes[k], nodes[(k + 1) % 3]), std::max(nodes[k], nodes[(k + 1) % 3])});
  }
  std::ranges::sort(sides);
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
  const auto at = [&](std::int32_t node) {
    return mesh.nodes[static_cast<std::size_t>(node)].position;
  };
  for (const auto& [a, b] : sides) points.push_back(halfway(at(a), at(b)));
  return points;
}

// As the slope of f there tells it, which is not so where the slope jumps.
std::vector<double> likely_distances(const LevelSet& set, std::span<const Point<3>> points) {
  std::vector<double> distances;
  for (std::size_t begin = 0; begin < points.size(); begin += kPointsAtOnce) {
    const std::size_t n = std::min(kPointsAtOnce, points.size() - begin);
    for (const LevelSetSlope& slope : set.slopes(points.subspan(begin, n))) {
      const double way = std::fabs(slope.f) / length(slope.gradient);
      distances.push_back(way <= set.resolution() ? way
                                                  : set.resolution());  // where it is NaN, too
    }
  }
  return distances;
}

double distance_to_triangles(const ResolvedVolume& volume, const LevelSet& set) {
  const std::vector<Point<3>> points = middles_of_triangles(volume, set);
  if (points.empty()) return 0;
  const std::vector<double> likely = likely_distances(set, points);
  const double farthest = *std::ranges::max_element(likely);
  std::vector<Point<3>> far;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (likely[k] >= kMayBeFarthest * farthest) far.push_back(points[k]);
  std::vector<Point<3>> projected = far;
  set.project(projected, set.resolution());
  return largest_distance(far, [&](std::size_t k) { return projected[k]; });
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
