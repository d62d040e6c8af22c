// SPDX-License-Identifier: BSD-3-Clause
// Stars of a volume's nodes while some of these go elsewhere, one at a time: the stars made before,
// and over them those that have changed since then.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/nodes.hpp"
#include "delaunay/volume/volume_stars.hpp"

namespace pnpbs {

// Its corners, by id where that is said, so that what is computed from them is the same everywhere.
using TetrahedronNodes = std::array<std::int32_t, 4>;

// What becomes of the triangulation if a node goes to x.
struct StarChange {
  std::int32_t node;
  Point<3> x;
  std::vector<TetrahedronNodes> gone, made;  // of positive orientation
};

class StarChanges {
 public:
  using Corners = std::array<std::int32_t, 3>;

  StarChanges(const Nodes<3>& nodes, const VolumeStars& stars) : nodes_(nodes), stars_(stars) {}

  // As those of VolumeStars, in some order.
  template <class Visit>
  void for_neighbours(std::int64_t i, const Visit& visit) const {
    const auto found = changed_.find(static_cast<std::int32_t>(i));
    if (found == changed_.end()) return stars_.for_neighbours(i, visit);
    for (const std::int32_t j : found->second.neighbours) visit(static_cast<std::int64_t>(j));
  }
  template <class Visit>
  void for_simplices(std::int64_t i, const Visit& visit) const {
    const auto found = changed_.find(static_cast<std::int32_t>(i));
    if (found == changed_.end()) return stars_.for_simplices(i, visit);
    for (const Corners& corners : found->second.simplices) visit(corners);
  }

  // Does a node of the tetrahedron move? Only such ones can be mended.
  bool any_moves(const TetrahedronNodes& tetrahedron) const {
    return std::any_of(tetrahedron.begin(), tetrahedron.end(),
                       [this](std::int32_t i) { return nodes_.moves(i); });
  }
  // Those around node i that are to be counted, their corners by id.
  void add_star(std::int64_t i, std::vector<TetrahedronNodes>& tetrahedra) const;
  TetrahedronNodes by_id(TetrahedronNodes corners) const;
  bool ids_less(const TetrahedronNodes& a, const TetrahedronNodes& b) const;
  void sort_by_id(std::vector<TetrahedronNodes>& tetrahedra) const;

  // The node has gone there. Returns the nodes whose stars have changed.
  std::vector<std::int32_t> accept(const StarChange& change);

 private:
  struct Star {
    std::vector<std::int32_t> neighbours;
    std::vector<Corners> simplices;
  };

  const Nodes<3>& nodes_;
  const VolumeStars& stars_;
  std::unordered_map<std::int32_t, Star> changed_;
};

}  // namespace pnpbs
