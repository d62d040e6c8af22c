// SPDX-License-Identifier: BSD-3-Clause
// Where an advancing front would put its first nodes: over each regular edge of the boundary, the
// third corner of an equilateral triangle. They follow from the boundary alone, so that all ranks
// agree on them.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/plane/incident_sectors.hpp"
#include "spacing/sized_tree.hpp"

namespace pnpbs {

struct BoundaryApex {
  std::int32_t edge;
  double edge_length;
  Point<2> place{};
  bool stands = false;  // else no node should come there
};

class BoundaryApexes {
 public:
  // Over these edges, on the sides that are inside the domain. spacing(b): d at boundary node b. An
  // edge beside these may be missing if it does not matter whether those near it stand.
  BoundaryApexes(const SizedTree<2>& map, const IncidentSectors& sectors,
                 const std::function<double(std::int32_t)>& spacing,
                 std::vector<std::int32_t> edges);

  // Those that stand and those that do not, in the order of the edges.
  const std::vector<BoundaryApex>& all() const { return apexes_; }
  // The one on that side of the edge, by its place among all; -1 where none stands.
  std::int64_t over(std::int32_t edge, bool left) const;
  // Those for which goes(apex) holds stand no longer.
  template <class Goes>
  void drop(const Goes& goes) {
    for (BoundaryApex& apex : apexes_) apex.stands = apex.stands && !goes(apex);
  }

 private:
  bool is_regular(std::int32_t edge) const;
  bool goes_straight_on(std::int32_t boundary_node) const;
  BoundaryApex made_over(std::int32_t edge, bool left) const;
  bool is_visible(const BoundaryApex& apex, const Point<2>& middle) const;
  bool is_crowded(const BoundaryApex& apex) const;

  const SizedTree<2>& map_;
  const IncidentSectors& sectors_;
  const std::function<double(std::int32_t)>& spacing_;
  std::vector<std::int32_t> edges_;   // by increasing index
  std::vector<BoundaryApex> apexes_;  // of each edge the one on its right, then that on its left
};

}  // namespace pnpbs
