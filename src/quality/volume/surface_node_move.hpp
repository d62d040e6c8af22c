// SPDX-License-Identifier: BSD-3-Clause
// Finds how the tetrahedra of the domain change if a node on a surface goes a little way along it.
// There the triangulation ends, and what is cut off differs with the place of the node. So the
// stars of the node and of all that are its neighbours before or after, across the outside as well,
// are made anew for both places, and compared.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "delaunay/volume/volume_star.hpp"
#include "quality/volume/star_changes.hpp"

namespace pnpbs {

class SurfaceNodeMove {
 public:
  // Is an element of these nodes, which are at these corners, part of the domain?
  using InDomain =
      std::function<bool(const std::array<std::int64_t, 4>& nodes, const Tetrahedron& corners)>;

  // `others`: nodes of the boundary around the node, on the far side of a wall or a gap as well.
  SurfaceNodeMove(const Nodes<3>& nodes, const StarChanges& stars, std::int32_t node,
                  std::span<const std::int32_t> others, const InDomain& in_domain);

  // To x on facet `on`: the tetrahedra of its own star there, which are some of those made, and
  // all that there are around it, among which are those gone.
  void go_to(const Point<3>& x, std::int32_t on);
  const StarChange& change() const { return change_; }
  // All those made, and none but those gone. False if the stars made from the nodes around are not
  // those that are there, or do not agree with each other.
  bool complete();

 private:
  struct Found {
    TetrahedronNodes by_id, oriented;
    bool operator<(const Found& other) const { return by_id < other.by_id; }
    bool operator==(const Found& other) const { return by_id == other.by_id; }
  };
  struct Star {
    std::vector<Found> tetrahedra;         // of the domain, in order
    std::vector<std::int32_t> neighbours;  // on the far side of the surface, too
  };

  VolumeNode node_at(std::int32_t i, const Point<3>& x) const {
    return {i == change_.node ? x : nodes_.position(i), nodes_.d(i), nodes_.id(i)};
  }
  Star star_of(std::int32_t i, const Point<3>& x);
  const Star& star_before(std::int32_t i);
  bool is_element(const Found& tetrahedron, const std::array<std::int64_t, 4>& nodes,
                  const Tetrahedron& corners);
  bool is_as_before(std::int32_t i);
  bool find_stars_after(std::vector<Found>& found);
  std::vector<Found> star_there(std::int32_t i) const;
  std::vector<Found> stars_there(const std::vector<std::int32_t>& centres) const;
  Found found(const TetrahedronNodes& t) const { return {stars_.by_id(t), t}; }

  const Nodes<3>& nodes_;
  const StarChanges& stars_;
  const InDomain& in_domain_;
  // Nodes around the node, and itself: those in two rings have all their neighbours in three.
  std::vector<std::int32_t> two_rings_, near_;
  std::vector<std::int32_t> centres_;  // of the stars that may change
  std::vector<Found> there_;           // their tetrahedra
  // What does not depend on where the node goes: the stars while it has not gone, and of tetrahedra
  // without it, by id, whether they are elements.
  std::map<std::int32_t, Star> before_;
  std::map<TetrahedronNodes, bool> elements_;
  StarChange change_;
};

}  // namespace pnpbs
