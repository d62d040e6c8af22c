// SPDX-License-Identifier: BSD-3-Clause
// Which straight ways lead through the domain, for a spacing that is measured along them: asked of
// the boundary alone, so that every rank can tell of any way.
#pragma once

#include <cstdint>
#include <iterator>
#include <memory>
#include <vector>

#include "domain/domain.hpp"
#include "domain/spacing_evaluator.hpp"
#include "geometry/facet_index.hpp"

namespace pnpbs {

template <int Dim>
class LineOfSight {
 public:
  enum class Side : char { outside, crossed, inside };

  // measure: the domain's area or volume. Of the boundary, whose leaves hold few facets each.
  LineOfSight(const Box<Dim>& bounds, double measure,
              std::shared_ptr<const FacetIndex<Dim>> facets);

  const Box<Dim>& bounds() const { return bounds_; }
  double measure() const { return measure_; }
  std::int64_t node_count() const { return std::ssize(facets_->boundary().nodes); }
  const Point<Dim>& node(std::int64_t n) const {
    return facets_->boundary().nodes[static_cast<std::size_t>(n)].position;
  }

  // Where the domain is in a box.
  Side side_of(const Box<Dim>& box) const;
  bool inside(const Point<Dim>& x) const { return facets_->inside(x); }
  // The point of the boundary that is nearest to x, if it is nearer than `reach`; else x.
  Point<Dim> nearest_of_boundary(const Point<Dim>& x, double reach) const;
  // Does the way from a to b cross no facet of the boundary? Ends may lie on one.
  bool open(const Point<Dim>& a, const Point<Dim>& b) const;

 private:
  Box<Dim> bounds_;
  double measure_;
  std::shared_ptr<const FacetIndex<Dim>> facets_;
  std::vector<char> has_facets_;  // of all cells of their tree: most have none
};

// The facets of the boundary: in the plane with the nodes that d asks for on it, in space those of
// the surfaces as they are given.
std::shared_ptr<const FacetIndex<2>> indexed_boundary(const PlaneDomain& domain,
                                                      const SpacingEvaluator<2>& d,
                                                      std::int64_t max_nodes);
std::shared_ptr<const FacetIndex<3>> indexed_boundary(const VolumeDomain& domain,
                                                      const SpacingEvaluator<3>& d,
                                                      std::int64_t max_nodes);

extern template class LineOfSight<2>;
extern template class LineOfSight<3>;

}  // namespace pnpbs
