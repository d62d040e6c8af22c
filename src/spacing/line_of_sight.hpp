// SPDX-License-Identifier: BSD-3-Clause
// Tests whether straight segments lie in the domain, for a spacing whose growth is measured along
// paths through the domain. The tests use the boundary alone, so every rank can test any segment.
#pragma once

#include <cstdint>
#include <iterator>
#include <memory>
#include <vector>

#include "domain/domain.hpp"
#include "domain/spacing_evaluator.hpp"
#include "geometry/facet_index.hpp"

namespace pnpbs {

// The boundary of a domain, with tests of boxes, points and segments against it.
template <int Dim>
class LineOfSight {
 public:
  enum class Side : char { outside, crossed, inside };

  // `measure` is the domain's area or volume. The leaves of the index must hold few facets each.
  LineOfSight(const Box<Dim>& bounds, double measure,
              std::shared_ptr<const FacetIndex<Dim>> facets);

  const Box<Dim>& bounds() const { return bounds_; }
  double measure() const { return measure_; }
  std::int64_t node_count() const { return std::ssize(facets_->boundary().nodes); }
  const Point<Dim>& node(std::int64_t n) const {
    return facets_->boundary().nodes[static_cast<std::size_t>(n)].position;
  }

  // Returns whether a box lies inside or outside of the domain, or may be crossed by the boundary.
  Side side_of(const Box<Dim>& box) const;
  bool inside(const Point<Dim>& x) const { return facets_->inside(x); }
  // Returns the point of the boundary nearest to x if it is nearer than `reach`, otherwise x.
  Point<Dim> nearest_of_boundary(const Point<Dim>& x, double reach) const;
  // Returns whether the segment from a to b crosses no facet of the boundary. Its ends may lie on
  // facets.
  bool open(const Point<Dim>& a, const Point<Dim>& b) const;

 private:
  Box<Dim> bounds_;
  double measure_;
  std::shared_ptr<const FacetIndex<Dim>> facets_;
  // For each cell of the tree: whether it contains facets; most do not.
  std::vector<char> has_facets_;
};

// Returns the facets of the boundary: in the plane those of the boundary discretised by d, in space
// those of the surfaces as given.
std::shared_ptr<const FacetIndex<2>> indexed_boundary(const PlaneDomain& domain,
                                                      const SpacingEvaluator<2>& d,
                                                      std::int64_t max_nodes);
std::shared_ptr<const FacetIndex<3>> indexed_boundary(const VolumeDomain& domain,
                                                      const SpacingEvaluator<3>& d,
                                                      std::int64_t max_nodes);

extern template class LineOfSight<2>;
extern template class LineOfSight<3>;

}  // namespace pnpbs
