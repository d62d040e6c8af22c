// SPDX-License-Identifier: BSD-3-Clause
// Which straight ways lead through the domain, for a spacing that is measured along them: asked of
// the boundary alone, so that every rank can tell of any way.
#pragma once

#include <cstdint>
#include <vector>

#include "domain/plane/boundary.hpp"
#include "domain/plane/plane_domain.hpp"
#include "spacing/domain_map.hpp"

namespace pnpbs {

template <int Dim>
class OpenWays;

template <>
class OpenWays<2> {
 public:
  using Domain = PlaneDomain;
  enum class Side : char { outside, crossed, inside };

  // The boundary with the nodes that d asks for on it.
  OpenWays(const PlaneDomain& domain, const SpacingEvaluator<2>& spacing, std::int64_t most_nodes);
  OpenWays(const OpenWays&) = delete;
  OpenWays& operator=(const OpenWays&) = delete;

  const Box<2>& bounds() const { return bounds_; }
  double measure() const { return area_; }
  std::int64_t node_count() const { return std::ssize(boundary_.nodes); }
  const Point<2>& node(std::int64_t n) const {
    return boundary_.nodes[static_cast<std::size_t>(n)].position;
  }

  // Where the domain is in a box.
  Side side_of(const Box<2>& box) const;
  bool inside(const Point<2>& x) const { return map_.inside(x); }
  // Does the way from a to b cross no boundary edge? Ends may lie on one.
  bool open(const Point<2>& a, const Point<2>& b) const;

 private:
  Box<2> bounds_;
  double area_;
  Boundary boundary_;
  DomainMap<2> map_;  // refined by the boundary alone
};

}  // namespace pnpbs
