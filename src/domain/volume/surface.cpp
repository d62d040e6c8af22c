// SPDX-License-Identifier: BSD-3-Clause
#include "domain/volume/surface.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "base/space_vectors.hpp"
#include "geometry/volume/triangles.hpp"

namespace pnpbs {

namespace {

// Largest deviation of a flat patch from its plane. [extent of the patch] Coordinates in single
// precision, as in files, have rounding errors of a tenth of this.
constexpr double kFlat = 1e-6;

// The fitted plane of a patch.
struct PatchPlane {
  Point<3> normal{};  // sum of the facets' normals, weighted by area
  Point<3> any{};     // a node of the patch
  bool any_known = false;
  double extent = 0, deviation = 0;
};

}  // namespace

Surface::Surface(const BoundaryMesh<3>& mesh, const Features& features)
    : mesh_(&mesh), features_(&features) {
  find_normals();
  edge_sides_ = sides_of_edges(mesh, features, normals_);
  corner_sides_ = sides_of_corners(mesh, features, normals_);
  build_rims();
}

// All facets of a flat patch get the normal of its plane, because the normals of needle-shaped
// facets are inaccurate.
void Surface::find_normals() {
  std::vector<PatchPlane> planes(index(features_->patches));
  const auto for_triangles = [&](const auto& visit) {
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(mesh_->facets.size()); ++f)
      if (patch(f) >= 0) visit(f, corners(f), planes[index(patch(f))]);
  };
  for (const BoundaryTriangle& facet : mesh_->facets)
    normals_.push_back(facet_normal(*mesh_, facet));
  for_triangles([](std::int32_t, const FacetCorners<3>& x, PatchPlane& plane) {
    const Point<3> normal = cross(difference(x[1], x[0]), difference(x[2], x[0]));
    plane.normal = shifted(plane.normal, 1, normal);
    if (!std::exchange(plane.any_known, true)) plane.any = x[0];
  });
  for (PatchPlane& plane : planes) plane.normal = unit_vector(plane.normal);
  for_triangles([](std::int32_t, const FacetCorners<3>& corners, PatchPlane& plane) {
    for (const Point<3>& x : corners) {
      const Point<3> way = difference(x, plane.any);
      plane.extent = std::max(plane.extent, length(way));
      plane.deviation = std::max(plane.deviation, std::fabs(dot(way, plane.normal)));
    }
  });
  for (const PatchPlane& plane : planes)
    flat_.push_back(plane.deviation <= kFlat * plane.extent && plane.normal != Point<3>{});
  for_triangles([&](std::int32_t f, const FacetCorners<3>&, const PatchPlane& plane) {
    if (dot(normal(f), plane.normal) < 0) flat_[index(patch(f))] = 0;  // a folded patch is not flat
  });
  for_triangles([&](std::int32_t f, const FacetCorners<3>&, const PatchPlane& plane) {
    if (is_flat(patch(f))) normals_[index(f)] = plane.normal;
  });
}

std::span<const SurfaceSide> Surface::feature_sides(const SurfaceSupport& place) const {
  return (place.on == SurfaceSupport::On::edge ? edge_sides_ : corner_sides_).of(place.index);
}

bool Surface::sees(const SurfaceSupport& a, const SurfaceSupport& b) const {
  bool seen = false;
  for_sides(a, [&](const SurfaceSide& side) { seen = seen || sees(side, b); });
  return seen;
}

bool Surface::sees(const SurfaceSide& side, const SurfaceSupport& b, double least_cosine) const {
  bool seen = false;
  for_sides(b, [&](const SurfaceSide& other) {
    seen = seen || (side.patch == other.patch && dot(side.normal, other.normal) > least_cosine);
  });
  return seen;
}

bool Surface::share_patch(std::span<const SurfaceSupport> places, double least_cosine) const {
  return std::all_of(places.begin(), places.end(), [&](const SurfaceSupport& from) {
    bool all_seen = false;
    for_sides(from, [&](const SurfaceSide& side) {
      all_seen =
          all_seen || std::all_of(places.begin(), places.end(), [&](const SurfaceSupport& to) {
            return &to == &from || sees(side, to, least_cosine);
          });
    });
    return all_seen;
  });
}

void Surface::build_rims() {
  rims_.resize(index(features_->patches));
  std::set<std::int32_t> on_curves;
  for (const FeatureCurve& curve : features_->curves) {
    on_curves.insert({curve.nodes.front(), curve.nodes.back()});
    for (std::size_t e = 0; e < curve.edge_count(); ++e) {
      std::set<std::int32_t> patches;
      for (const std::int32_t f : curve.facets[e])
        if (patch(f) >= 0) patches.insert(patch(f));
      for (const std::int32_t p : patches)
        rims_[index(p)].ends.push_back({curve.nodes[e], curve.nodes[e + 1]});
    }
  }
  for (const std::int32_t corner : features_->corners)
    if (!on_curves.contains(corner))
      for (const std::int32_t p : features_->patches_at[index(corner)])
        rims_[index(p)].ends.push_back({corner, corner});
  for (Rim& rim : rims_) {
    std::vector<Box<3>> boxes;
    for (const auto& [a, b] : rim.ends)
      boxes.push_back(joined(Box<3>{position(a), position(a)}, {position(b), position(b)}));
    rim.boxes = BoxTree<3>(std::move(boxes));
  }
}

double Surface::feature_clearance(const SurfacePoint& at, double reach) const {
  const Rim& rim = rims_[index(patch(at.facet))];
  double gap = reach;
  rim.boxes.for_near(
      at.position, [&] { return gap * gap; },
      [&](std::int32_t n) {
        const auto& [a, b] = rim.ends[index(n)];
        const Point<3> nearest = nearest_on({position(a), position(b), position(b)}, at.position);
        gap = std::min(gap, distance<3>(nearest, at.position));
      });
  return gap;
}

}  // namespace pnpbs
