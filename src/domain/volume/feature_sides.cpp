// SPDX-License-Identifier: BSD-3-Clause
#include "domain/volume/feature_sides.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/index.hpp"
#include "base/space_vectors.hpp"

namespace pnpbs {

namespace {

// Returns the index of the node among the facet's corners; 3 if it is none of them.
std::size_t corner_at(const BoundaryTriangle& facet, std::int32_t node) {
  const auto at = std::find(facet.nodes.begin(), facet.nodes.end(), node);
  return static_cast<std::size_t>(at - facet.nodes.begin());
}

// Returns true if an edge of the facet leads from one node to the other.
bool leads(const BoundaryTriangle& facet, std::int32_t from, std::int32_t to) {
  return facet.nodes[(corner_at(facet, from) + 1) % 3] == to;
}

class CornerSectors {
 public:
  CornerSectors(const BoundaryMesh<3>& mesh, const Features& features,
                std::span<const Point<3>> normals)
      : mesh_(mesh), features_(features), normals_(normals) {}

  FeatureSides run() {
    gather_facets();
    gather_ends();
    for (const std::int32_t corner : features_.corners) add_sectors(corner);
    return std::move(found_);
  }

 private:
  // The mesh node of a corner, and a facet there.
  using Place = std::pair<std::int32_t, std::int32_t>;

  const BoundaryTriangle& facet(std::int32_t f) const { return mesh_.facets[index(f)]; }

  void gather_facets() {
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(mesh_.facets.size()); ++f)
      for (const std::int32_t node : facet(f).nodes)
        if (features_.patch[index(f)] >= 0 && features_.is_corner(node)) facets_[node].push_back(f);
  }

  // Stores the curves that bound the first and the last facets of the sectors.
  void gather_ends() {
    for (std::int32_t c = 0; c < static_cast<std::int32_t>(features_.curves.size()); ++c) {
      const FeatureCurve& curve = features_.curves[index(c)];
      if (!features_.is_corner(curve.nodes.front())) continue;
      add_end(curve.nodes[0], curve.nodes[1], curve.facets.front(), {c, true});
      const std::size_t last = curve.nodes.size() - 1;
      add_end(curve.nodes[last], curve.nodes[last - 1], curve.facets.back(), {c, false});
    }
  }

  void add_end(std::int32_t corner, std::int32_t next, const std::vector<std::int32_t>& facets,
               const CurveDirection& way) {
    for (const std::int32_t f : facets)
      if (features_.patch[index(f)] >= 0)
        (leads(facet(f), corner, next) ? begins_ : ends_)[Place{corner, f}] = way;
  }

  // Adds the sectors that begin at a feature edge, then those that no feature edge bounds.
  void add_sectors(std::int32_t corner) {
    const std::vector<std::int32_t>& facets = facets_[corner];
    std::map<std::int32_t, bool> done;
    for (const bool from_feature : {true, false})
      for (const std::int32_t f : facets) {
        const auto begin = begins_.find({corner, f});
        if (done[f] || (begin != begins_.end()) != from_feature) continue;
        SurfaceSide side{features_.patch[index(f)], {}, {}, {}};
        if (from_feature) side.begin = begin->second;
        std::int32_t last = f;
        for (std::int32_t g = f; g >= 0 && !done[g]; g = after(g, corner)) {
          done[g] = true;
          last = g;
          side.normal = shifted(side.normal, angle(g, corner), normals_[index(g)]);
        }
        if (from_feature) side.end = ends_.at({corner, last});
        side.normal = unit_vector(side.normal);
        found_.sides.push_back(side);
      }
    found_.begin.push_back(found_.sides.size());
  }

  // Returns the next facet counter-clockwise around the node.
  std::int32_t after(std::int32_t f, std::int32_t node) const {
    return features_.across[index(f)][(corner_at(facet(f), node) + 2) % 3];
  }

  double angle(std::int32_t f, std::int32_t node) const {
    const std::size_t k = corner_at(facet(f), node);
    const FacetCorners<3> x = corners_of(mesh_, facet(f));
    const Point<3> to_next = difference(x[(k + 1) % 3], x[k]);
    const Point<3> to_last = difference(x[(k + 2) % 3], x[k]);
    return std::atan2(length(cross(to_next, to_last)), dot(to_next, to_last));
  }

  const BoundaryMesh<3>& mesh_;
  const Features& features_;
  std::span<const Point<3>> normals_;
  std::map<std::int32_t, std::vector<std::int32_t>> facets_;  // at each corner
  std::map<Place, CurveDirection> begins_, ends_;
  FeatureSides found_;
};

}  // namespace

FeatureSides sides_of_edges(const BoundaryMesh<3>& mesh, const Features& features,
                            std::span<const Point<3>> normals) {
  FeatureSides found;
  for (std::int32_t c = 0; c < static_cast<std::int32_t>(features.curves.size()); ++c) {
    const FeatureCurve& curve = features.curves[index(c)];
    for (std::size_t e = 0; e < curve.edge_count(); ++e) {
      for (const std::int32_t f : curve.facets[e]) {
        const std::int32_t patch = features.patch[index(f)];
        if (patch < 0) continue;
        const bool forward = leads(mesh.facets[index(f)], curve.nodes[e], curve.nodes[e + 1]);
        found.sides.push_back({patch, normals[index(f)], {c, forward}, {c, !forward}});
      }
      found.begin.push_back(found.sides.size());
    }
  }
  return found;
}

FeatureSides sides_of_corners(const BoundaryMesh<3>& mesh, const Features& features,
                              std::span<const Point<3>> normals) {
  return CornerSectors(mesh, features, normals).run();
}

}  // namespace pnpbs
