// SPDX-License-Identifier: BSD-3-Clause
// Triangulated surfaces as bubbles on them see them: facets with their normals, and features with
// the patches on each side of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "domain/volume/feature_sides.hpp"
#include "domain/volume/features.hpp"
#include "geometry/boundary_mesh.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

struct SurfacePoint {
  std::int32_t facet;
  Point<3> position;
};

// What a node on a surface lies on: a facet, a feature edge, or a corner of the features (index
// into Features::corners).
struct SurfacePlace {
  enum class On : std::int8_t { facet, edge, corner };
  On on;
  std::int32_t index;
};

class Surface {
 public:
  // Mesh and features must outlive it.
  Surface(const BoundaryMesh<3>& mesh, const Features& features);

  const BoundaryMesh<3>& mesh() const { return *mesh_; }
  const Features& features() const { return *features_; }

  FacetCorners<3> corners(std::int32_t f) const { return corners_of(*mesh_, facet(f)); }
  const BoundaryTriangle& facet(std::int32_t f) const { return mesh_->facets[index(f)]; }
  // Across edge k; -1 at a feature.
  std::int32_t across(std::int32_t f, int k) const {
    return features_->across[index(f)][static_cast<std::size_t>(k)];
  }
  std::int32_t patch(std::int32_t f) const { return features_->patch[index(f)]; }
  // Unit; the same one, to the bit, for all facets of a flat patch.
  const Point<3>& normal(std::int32_t f) const { return normals_[index(f)]; }
  bool is_flat(std::int32_t patch) const { return flat_[index(patch)] != 0; }

  // Does any feature bound the patch, or lie in it?
  bool has_features(std::int32_t patch) const { return !rims_[index(patch)].ends.empty(); }

  // Calls visit(side) for the sides around a place.
  template <class Visit>
  void for_sides(const SurfacePlace& place, const Visit& visit) const {
    if (place.on == SurfacePlace::On::facet) {
      visit(SurfaceSide{patch(place.index), normal(place.index), {}, {}});
      return;
    }
    for (const SurfaceSide& side : feature_sides(place)) visit(side);
  }

  // Do nodes at these places see each other? If they share a patch and the normals there differ by
  // less than 90 degrees: so far the patch can be seen as a graph over its tangent plane, while the
  // two sheets of a thin body that one patch goes around look apart.
  bool sees(const SurfacePlace& a, const SurfacePlace& b) const;
  // The same of one side of a place alone.
  bool sees(const SurfaceSide& side, const SurfacePlace& b, double least_cosine = 0) const;
  // Do nodes at these places lie on one patch, side by side, so that each sees all others there? At
  // a corner between three patches each two of them may do so, but not all on the same one.
  // With another least cosine of the angle between normals, they need not see each other.
  bool share_patch(std::span<const SurfacePlace> places, double least_cosine = 0) const;

  // The distance to the nearest feature of the patch if it is less than `reach`, else `reach`.
  double feature_clearance(const SurfacePoint& at, double reach) const;

 private:
  struct Rim {  // of a patch: its feature edges, and fixed nodes on it
    std::vector<std::array<std::int32_t, 2>> ends;
    BoxTree<3> boxes;
  };

  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  std::span<const SurfaceSide> feature_sides(const SurfacePlace& place) const;
  const Point<3>& position(std::int32_t mesh_node) const {
    return mesh_->nodes[index(mesh_node)].position;
  }

  void find_normals();
  void build_rims();

  const BoundaryMesh<3>* mesh_;
  const Features* features_;
  std::vector<Point<3>> normals_;  // of the facets
  std::vector<char> flat_;         // of the patches
  FeatureSides edge_sides_, corner_sides_;
  std::vector<Rim> rims_;
};

}  // namespace pnpbs
