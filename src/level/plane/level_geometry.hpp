// SPDX-License-Identifier: BSD-3-Clause
// What a level in the plane stands on: the domain, the spacing, and the boundary discretized at
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
#include "spacing/spacing.hpp"

namespace pnpbs {

template <int Dim>
class LevelGeometry;

template <>
class LevelGeometry<2> {
 public:
  // Throws Error(ErrorKind::spacing) if the boundary had more nodes than the limit allows.
  LevelGeometry(std::shared_ptr<const PlaneDomain> domain,
                std::shared_ptr<const Spacing<2>> spacing, const NodeLimit& limit);
  LevelGeometry(const LevelGeometry<2>&) = delete;  // the tree points to the boundary
  LevelGeometry<2>& operator=(const LevelGeometry<2>&) = delete;

  const PlaneDomain& domain() const { return *domain_; }
  const Box<2>& bounds() const { return domain_->bounds(); }
  double measure() const { return domain_->area(); }
  GeometryKind kind() const { return domain_->kind(); }
  const Spacing<2>& spacing() const { return *spacing_; }
  SpacingEvaluator<2> evaluator() const;  // d, checked; while this ground is there
  const Boundary& boundary() const { return boundary_; }
  const std::vector<Warning>& warnings() const { return boundary_.warnings; }
  const IncidentSectors& sectors() const { return sectors_; }
  std::int64_t boundary_nodes() const { return static_cast<std::int64_t>(boundary_.nodes.size()); }

  // Of a boundary node: d there, and how large its bubble may be (see bubbles_on_boundary).
  double boundary_spacing(std::int64_t b) const { return boundary_spacing_[index(b)]; }
  double bubble_bound(std::int64_t b) const { return bubble_bound_[index(b)]; }

  // d of a bubble at node i where the spacing is d.
  double bubble_at(const Nodes<2>& nodes, std::int64_t i, double d) const {
    return nodes.boundary_node(i) < 0 ? d : std::min(d, bubble_bound(nodes.boundary_node(i)));
  }
  // d at node i as it is asked for: a bubble on a fine boundary is smaller.
  double spacing_at(const Nodes<2>& nodes, std::int64_t i) const {
    return nodes.boundary_node(i) < 0 ? nodes.d(i) : boundary_spacing(nodes.boundary_node(i));
  }
  // Does the domain end at an edge of this boundary node?
  bool bounds_domain_at(std::int32_t b) const {
    bool bounds = false;
    for (std::int32_t k = sectors_.begin(b); k < sectors_.end(b); ++k)
      bounds = bounds || boundary_.facets[index(sectors_.edge(k).edge)].bounds();
    return bounds;
  }
  // Are these the ends of a boundary edge?
  bool on_one_edge(const Nodes<2>& nodes, std::int64_t i, std::int64_t j) const {
    return nodes.boundary_node(i) >= 0 && nodes.boundary_node(j) >= 0 &&
           sectors_.joined(nodes.boundary_node(i), nodes.boundary_node(j));
  }

 private:
  void require_one_triangle_left() const;
  static std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

  std::shared_ptr<const PlaneDomain> domain_;
  std::shared_ptr<const Spacing<2>> spacing_;
  Boundary boundary_;
  IncidentSectors sectors_;
  std::vector<double> bubble_bound_, boundary_spacing_;
};

}  // namespace pnpbs
