// SPDX-License-Identifier: BSD-3-Clause
// The apexes over the edges of the boundary: the positions at which an advancing front would put
// its first nodes. The apex over a regular edge is the third corner of an equilateral triangle.
// Apexes depend on the boundary alone, so all ranks compute the same ones.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/plane/incident_sectors.hpp"
#include "spacing/sized_tree.hpp"

namespace pnpbs {

// The apex over one side of a boundary edge.
struct BoundaryApex {
  std::int32_t edge;
  double edge_length;
  Point<2> place{};
  bool stands = false;  // false: no node may be put at this apex
};

// The apexes over a set of boundary edges.
class BoundaryApexes {
 public:
  // Builds the apexes over `edges` on the sides that lie inside the domain. spacing(b) returns d at
  // boundary node b. All references must outlive this object. Whether an apex stands also depends
  // on the apexes of edges near it, so `edges` must contain all edges close to those of interest.
  BoundaryApexes(const SizedTree<2>& map, const IncidentSectors& sectors,
                 const std::function<double(std::int32_t)>& spacing,
                 std::vector<std::int32_t> edges);

  // Returns all apexes, standing or not, in the order of the edges.
  const std::vector<BoundaryApex>& all() const { return apexes_; }
  // Returns the index in all() of the apex on this side of the edge, or -1 if none stands there.
  std::int64_t over(std::int32_t edge, bool left) const;
  // Removes the apexes for which goes(apex) is true: they stand no longer.
  template <class Goes>
  void drop(const Goes& goes) {
    for (BoundaryApex& apex : apexes_) apex.stands = apex.stands && !goes(apex);
  }

 private:
  bool is_regular(std::int32_t edge) const;
  bool is_smooth_at(std::int32_t boundary_node) const;
  BoundaryApex made_over(std::int32_t edge, bool left) const;
  bool is_visible(const BoundaryApex& apex, const Point<2>& middle) const;
  bool is_crowded(const BoundaryApex& apex) const;

  const SizedTree<2>& map_;
  const IncidentSectors& sectors_;
  const std::function<double(std::int32_t)>& spacing_;
  std::vector<std::int32_t> edges_;   // ascending
  std::vector<BoundaryApex> apexes_;  // two for each edge: right side, then left side
};

}  // namespace pnpbs
