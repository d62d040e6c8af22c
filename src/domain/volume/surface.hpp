// SPDX-License-Identifier: BSD-3-Clause
// Triangulated surfaces as the bubbles on them need them: facets with normals, and features with
// the patches on each side.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "domain/volume/feature_sides.hpp"
#include "domain/volume/features.hpp"
#include "geometry/boundary_mesh.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

// A point on a facet.
struct SurfacePoint {
  std::int32_t facet;
  Point<3> position;
};

// The part of a surface that carries a node: a facet, a feature edge or a corner. `index` refers to
// the mesh's facets, to the feature edges or to Features::corners.
struct SurfaceSupport {
  enum class On : std::int8_t { facet, edge, corner };
  On on;
  std::int32_t index;
};

// A mesh with its features, and queries that nodes on it need.
class Surface {
 public:
  // `mesh` and `features` must outlive this object.
  Surface(const BoundaryMesh<3>& mesh, const Features& features);

  const BoundaryMesh<3>& mesh() const { return *mesh_; }
  const Features& features() const { return *features_; }

  FacetCorners<3> corners(std::int32_t f) const { return corners_of(*mesh_, facet(f)); }
  const BoundaryTriangle& facet(std::int32_t f) const { return mesh_->facets[index(f)]; }
  // Returns the facet across edge k; -1 at a feature.
  std::int32_t across(std::int32_t f, int k) const {
    return features_->across[index(f)][static_cast<std::size_t>(k)];
  }
  std::int32_t patch(std::int32_t f) const { return features_->patch[index(f)]; }
  // Returns the unit normal. All facets of a flat patch have bitwise the same.
  const Point<3>& normal(std::int32_t f) const { return normals_[index(f)]; }
  bool is_flat(std::int32_t patch) const { return flat_[index(patch)] != 0; }

  // Returns true if a feature bounds the patch or lies in it.
  bool has_features(std::int32_t patch) const { return !rims_[index(patch)].ends.empty(); }

  // Calls visit(side) for each side around a node's location.
  template <class Visit>
  void for_sides(const SurfaceSupport& place, const Visit& visit) const {
    if (place.on == SurfaceSupport::On::facet) {
      visit(SurfaceSide{patch(place.index), normal(place.index), {}, {}});
      return;
    }
    for (const SurfaceSide& side : feature_sides(place)) visit(side);
  }

  // Returns true if nodes at a and b interact: they share a patch, and its normals there differ by
  // less than 90 degrees. Up to that angle the patch is a graph over its tangent plane; the two
  // sheets of a thin body covered by one patch do not see each other.
  bool sees(const SurfaceSupport& a, const SurfaceSupport& b) const;
  // Does the same for one side of a location. `least_cosine` bounds the cosine of the angle.
  bool sees(const SurfaceSide& side, const SurfaceSupport& b, double least_cosine = 0) const;
  // Returns true if each location has a side that sees all the others. At a corner between three
  // patches each two locations may share a patch, but not all of them the same one. `least_cosine`
  // bounds the cosine of the angle between normals.
  bool share_patch(std::span<const SurfaceSupport> places, double least_cosine = 0) const;

  // Returns the distance to the nearest feature of the patch, or `reach` if that is smaller.
  double feature_clearance(const SurfacePoint& at, double reach) const;

 private:
  struct Rim {  // feature edges of a patch and fixed nodes on it
    std::vector<std::array<std::int32_t, 2>> ends;
    BoxTree<3> boxes;
  };

  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  std::span<const SurfaceSide> feature_sides(const SurfaceSupport& place) const;
  const Point<3>& position(std::int32_t mesh_node) const {
    return mesh_->nodes[index(mesh_node)].position;
  }

  void find_normals();
  void build_rims();

  const BoundaryMesh<3>* mesh_;
  const Features* features_;
  std::vector<Point<3>> normals_;  // per facet
  std::vector<char> flat_;         // per patch
  FeatureSides edge_sides_, corner_sides_;
  std::vector<Rim> rims_;
};

}  // namespace pnpbs
