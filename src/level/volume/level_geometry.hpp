// SPDX-License-Identifier: BSD-3-Clause
// The geometry of a level in space: the domain with its surfaces, the spacing, and the nodes on
// feature edges.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/nodes.hpp"
#include "base/warning.hpp"
#include "domain/node_limit.hpp"
#include "domain/spacing_evaluator.hpp"
#include "domain/volume/feature_nodes.hpp"
#include "domain/volume/surface.hpp"
#include "domain/volume/volume_domain.hpp"
#include "initial/incoming_nodes.hpp"
#include "level/images_of_points.hpp"
#include "spacing/spacing.hpp"
#include "tree/background_tree.hpp"

namespace pnpbs {

template <int Dim>
class LevelGeometry;

// The geometry of a level in space. It never changes. Nodes::boundary_node is the facet of a
// surface node, the index among the feature nodes of a node on a curve or in a corner, and -1 for
// an inner node.
template <>
class LevelGeometry<3> {
 public:
  // Throws Error(ErrorKind::spacing) if the feature edges or the largest triangles would have more
  // nodes than the limit allows.
  LevelGeometry(std::shared_ptr<const VolumeDomain> domain,
                std::shared_ptr<const Spacing<3>> spacing, const NodeLimit& limit);
  LevelGeometry(const LevelGeometry&) = delete;  // the tree points to the boundary
  LevelGeometry& operator=(const LevelGeometry&) = delete;

  const VolumeDomain& domain() const { return *domain_; }
  const Box<3>& bounds() const { return bounds_; }  // box of all nodes
  // Returns the cell of a periodic domain, and what a tree covers.
  const PeriodicCell<3>& cell() const { return domain_->cell(); }
  TreeBounds<3> tree_bounds() const { return {bounds(), cell()}; }
  double measure() const { return domain_->volume(); }
  GeometryKind kind() const { return kind_; }  // at the time of construction
  const Spacing<3>& spacing() const { return *spacing_; }
  // Returns checked values of d; must not outlive this object.
  SpacingEvaluator<3> evaluator() const;
  const BoundaryMesh<3>& boundary() const { return domain_->mesh(); }
  const Surface& surface() const { return surface_; }
  const FeatureNodes& features() const { return features_; }
  const std::vector<Warning>& warnings() const { return warnings_; }

  double bubble_at(const Nodes<3>&, std::int64_t, double d) const { return d; }
  double spacing_at(const Nodes<3>& nodes, std::int64_t i) const { return nodes.d(i); }

  // Returns the part of the surface that a boundary node lies on. `on` is its boundary_node, now or
  // at the last event.
  SurfaceSupport place(Carrier carrier, std::int32_t on) const;
  SurfaceSupport place(const Nodes<3>& nodes, std::int64_t i) const {
    return place(nodes.carrier(i), nodes.boundary_node(i));
  }
  // Returns whether the domain lies on only one side of the facet.
  bool bounds_domain(std::int32_t facet) const { return boundary().facets[index(facet)].bounds(); }
  bool patch_bounds_domain(std::int32_t patch) const { return patch_bounds_[index(patch)] != 0; }
  // Returns whether the facet is a triangle of an inner surface, and not of an inner curve or a
  // fixed node.
  bool on_inner_surface(std::int32_t facet) const {
    return surface_.patch(facet) >= 0 && !bounds_domain(facet);
  }
  // Returns whether the body has inner surfaces. It is false for surfaces without a body.
  bool has_inner_surfaces() const {
    return kind_ == GeometryKind::body &&
           std::ranges::find(patch_bounds_, 0) != patch_bounds_.end();
  }

  // Returns the boundary_node of a node where another copy of the periodic cell is seen as the
  // cell.
  std::int32_t boundary_seen_from(const Image<3>& image, Carrier carrier, std::int32_t on) const {
    return carrier == Carrier::surface ? images_of_facets_.seen_from(image, on)
                                       : images_of_feature_nodes_.seen_from(image, on);
  }

  // Returns whether a feature node lies in the cell of a periodic domain. True for other domains.
  bool feature_node_in_cell(std::int32_t n) const { return images_of_feature_nodes_.in_cell(n); }

  // Returns the nodes on feature edges and in corners, the same on all ranks.
  IncomingNodes<3> feature_nodes() const;

 private:
  void find_images();
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

  std::shared_ptr<const VolumeDomain> domain_;
  GeometryKind kind_;
  std::shared_ptr<const Spacing<3>> spacing_;
  Box<3> bounds_;
  Surface surface_;
  FeatureNodes features_;
  ImagesOfPoints<3> images_of_facets_, images_of_feature_nodes_;  // in a periodic domain
  std::vector<char> patch_bounds_;  // per patch: whether the domain lies on only one side
  std::vector<Warning> warnings_;
};

}  // namespace pnpbs
