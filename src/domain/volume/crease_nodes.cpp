// SPDX-License-Identifier: BSD-3-Clause
#include "domain/volume/crease_nodes.hpp"

#include <cstddef>
#include <vector>

#include "base/index.hpp"
#include "base/space_vectors.hpp"
#include "implicit/level_set_kinks.hpp"

namespace pnpbs {

namespace {

struct CreaseAtNode {
  const LevelSet* set = nullptr;
  std::array<Point<3>, 2> normals;  // of the sides
  std::array<Point<3>, 2> ways;     // unit, along the surface, away from the edge
};

CreaseAtNode crease_at(const ResolvedVolume& volume, const FeatureNode& node) {
  CreaseAtNode at;
  if (node.curve < 0) return at;
  const LevelSetTriangles& sets = volume.level_sets;
  const FeatureCurve& curve = volume.features.curves[index(node.curve)];
  const std::size_t e = index(node.edge - curve.first_edge);
  const LevelSetCrease* const crease = sets.crease(curve.nodes[e], curve.nodes[e + 1]);
  if (!crease) return at;
  at.set = sets.at(curve.facets[e].front());
  at.normals = crease->normals;
  const auto place = [&](std::int32_t n) { return volume.mesh.nodes[index(n)].position; };
  const Point<3> along = difference(place(crease->nodes[1]), place(crease->nodes[0]));
  at.ways = {unit_vector(cross(at.normals[0], along)), unit_vector(cross(along, at.normals[1]))};
  return at;
}

}  // namespace

void put_on_creases(const ResolvedVolume& volume, FeatureNodes& laid, double reach) {
  constexpr double kAside = 0.2;  // resolutions
  if (volume.level_sets.creases.empty()) return;
  for (const auto& set : volume.level_sets.sets) {
    if (!set) continue;
    std::vector<std::size_t> nodes;
    std::vector<CreaseSearch> searches;
    for (std::size_t n = 0; n < laid.nodes.size(); ++n) {
      const CreaseAtNode at = crease_at(volume, laid.nodes[n]);
      if (at.set != set.get()) continue;
      const Point<3>& x = laid.nodes[n].position;
      const double aside = kAside * set->resolution();
      nodes.push_back(n);
      searches.push_back({{shifted(x, aside, at.ways[0]), shifted(x, aside, at.ways[1])},
                          shifted(at.normals[0], 1, at.normals[1])});
    }
    const auto found = find_crease_points(*set, searches);
    for (std::size_t k = 0; k < found.size(); ++k) {
      Point<3>& x = laid.nodes[nodes[k]].position;
      if (found[k] && distance<3>(found[k]->position, x) <= reach) x = found[k]->position;
    }
  }
}

// At two distances, from which it follows at none.
std::array<Point<3>, 2> normals_beside(const ResolvedVolume& volume, const FeatureNode& node) {
  constexpr double kAside = 1e-3;  // resolutions
  const CreaseAtNode at = crease_at(volume, node);
  std::array<Point<3>, 2> normals{};
  if (!at.set) return normals;
  std::vector<Point<3>> places;
  for (const Point<3>& way : at.ways)
    for (const double steps : {1.0, 2.0})
      places.push_back(shifted(node.position, steps * kAside * at.set->resolution(), way));
  const std::vector<LevelSetSlope> slopes = at.set->slopes(places);
  for (std::size_t side = 0; side < 2; ++side) {
    const Point<3> near = slopes[2 * side].normal(), far = slopes[2 * side + 1].normal();
    normals[side] = unit_vector(shifted(near, 1, difference(near, far)));
  }
  return normals;
}

}  // namespace pnpbs
