// SPDX-License-Identifier: BSD-3-Clause
// The geometry of a level in the plane: the domain, the spacing, and the boundary discretized at
// that spacing.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/nodes.hpp"
#include "base/warning.hpp"
#include "domain/node_limit.hpp"
#include "domain/plane/boundary.hpp"
#include "domain/plane/plane_domain.hpp"
#include "geometry/plane/incident_sectors.hpp"
#include "level/images_of_points.hpp"
#include "spacing/spacing.hpp"
#include "tree/background_tree.hpp"

namespace pnpbs {

template <int Dim>
class LevelGeometry;

// The geometry of a level in the plane. It never changes.
template <>
class LevelGeometry<2> {
 public:
  // Throws Error(ErrorKind::spacing) if the boundary would have more nodes than the limit allows.
  LevelGeometry(std::shared_ptr<const PlaneDomain> domain,
                std::shared_ptr<const Spacing<2>> spacing, const NodeLimit& limit);
  LevelGeometry(const LevelGeometry<2>&) = delete;  // the tree points to the boundary
  LevelGeometry<2>& operator=(const LevelGeometry<2>&) = delete;

  const PlaneDomain& domain() const { return *domain_; }
  const Box<2>& bounds() const { return domain_->bounds(); }
  // Returns the cell of a periodic domain, and what a tree covers.
  const PeriodicCell<2>& cell() const { return domain_->cell(); }
  TreeBounds<2> tree_bounds() const { return {bounds(), cell()}; }
  double measure() const { return domain_->area(); }
  GeometryKind kind() const { return domain_->kind(); }
  const Spacing<2>& spacing() const { return *spacing_; }
  // Returns checked values of d; must not outlive this object.
  SpacingEvaluator<2> evaluator() const;
  const Boundary& boundary() const { return boundary_; }
  const std::vector<Warning>& warnings() const { return boundary_.warnings; }
  const IncidentSectors& sectors() const { return sectors_; }
  std::int64_t boundary_nodes() const { return static_cast<std::int64_t>(boundary_.nodes.size()); }
  // Returns the boundary_node of a node where another copy of the periodic cell is seen as the
  // cell.
  std::int32_t boundary_seen_from(const Image<2>& image, Carrier, std::int32_t b) const {
    return images_.seen_from(image, b);
  }
  // Returns whether a boundary node lies in the cell of a periodic domain. True for other domains.
  bool boundary_node_in_cell(std::int64_t b) const {
    return images_.in_cell(static_cast<std::int32_t>(b));
  }
  const ImagesOfPoints<2>& images_of_boundary_nodes() const { return images_; }

  // Return d at a boundary node, and the upper limit of its bubble (see bubbles_on_boundary).
  double boundary_spacing(std::int64_t b) const { return boundary_spacing_[index(b)]; }
  double bubble_bound(std::int64_t b) const { return bubble_bound_[index(b)]; }

  // Returns the d of the bubble at node i for the spacing d.
  double bubble_at(const Nodes<2>& nodes, std::int64_t i, double d) const {
    return nodes.boundary_node(i) < 0 ? d : std::min(d, bubble_bound(nodes.boundary_node(i)));
  }
  // Returns the spacing at node i. The bubble at a node of a fine boundary may be smaller.
  double spacing_at(const Nodes<2>& nodes, std::int64_t i) const {
    return nodes.boundary_node(i) < 0 ? nodes.d(i) : boundary_spacing(nodes.boundary_node(i));
  }
  // Returns whether an edge at this boundary node bounds the domain.
  bool bounds_domain_at(std::int32_t b) const {
    bool bounds = false;
    for (std::int32_t k = sectors_.begin(b); k < sectors_.end(b); ++k)
      bounds = bounds || boundary_.facets[index(sectors_.edge(k).edge)].bounds();
    return bounds;
  }
  // Returns whether the two nodes are the ends of one boundary edge.
  bool on_one_edge(const Nodes<2>& nodes, std::int64_t i, std::int64_t j) const {
    return nodes.boundary_node(i) >= 0 && nodes.boundary_node(j) >= 0 &&
           sectors_.joined(nodes.boundary_node(i), nodes.boundary_node(j));
  }

 private:
  void find_images();
  void require_one_triangle_left() const;
  static std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

  std::shared_ptr<const PlaneDomain> domain_;
  std::shared_ptr<const Spacing<2>> spacing_;
  Boundary boundary_;
  ImagesOfPoints<2> images_;  // of the boundary nodes of a periodic domain
  IncidentSectors sectors_;
  std::vector<double> bubble_bound_, boundary_spacing_;
};

}  // namespace pnpbs
