// SPDX-License-Identifier: BSD-3-Clause
// Which straight ways lead through the domain, for a spacing that is measured along them: asked of
// the boundary alone, so that every rank can tell of any way.
#pragma once

#include <cstdint>
#include <iterator>

#include "domain/boundary_mesh.hpp"
#include "spacing/domain_map.hpp"

namespace pnpbs {

template <int Dim>
class OpenWays {
 public:
  enum class Side : char { outside, crossed, inside };

  // measure: the domain's area or volume. The boundary has the nodes that d asks for on it.
  OpenWays(const Box<Dim>& bounds, double measure, BoundaryMesh<Dim> boundary);
  OpenWays(const OpenWays&) = delete;  // the map points to the boundary
  OpenWays& operator=(const OpenWays&) = delete;

  const Box<Dim>& bounds() const { return bounds_; }
  double measure() const { return measure_; }
  std::int64_t node_count() const { return std::ssize(boundary_.nodes); }
  const Point<Dim>& node(std::int64_t n) const {
    return boundary_.nodes[static_cast<std::size_t>(n)].position;
  }

  // Where the domain is in a box.
  Side side_of(const Box<Dim>& box) const;
  bool inside(const Point<Dim>& x) const { return map_.inside(x); }
  // Does the way from a to b cross no facet of the boundary? Ends may lie on one.
  bool open(const Point<Dim>& a, const Point<Dim>& b) const;

 private:
  Box<Dim> bounds_;
  double measure_;
  BoundaryMesh<Dim> boundary_;
  DomainMap<Dim> map_;  // refined by the boundary alone
};

extern template class OpenWays<2>;
extern template class OpenWays<3>;

}  // namespace pnpbs
