// SPDX-License-Identifier: BSD-3-Clause
// Change of the elements when a node on a surface moves along the surface. The triangulation ends
// at the surface, and the part outside of the domain depends on the position of the node. The stars
// of the node and of all its neighbours before or after the move, including those across the
// outside, are therefore computed for both positions and compared.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "delaunay/volume/volume_star.hpp"
#include "quality/volume/star_changes.hpp"

namespace pnpbs {

// The moves of one surface node that are tried one after another. All references must outlive this
// object.
class SurfaceNodeMove {
 public:
  // Returns whether a tetrahedron with these nodes at these corners is an element of the domain.
  using InDomain =
      std::function<bool(const std::array<std::int64_t, 4>& nodes, const Tetrahedron& corners)>;

  // `others` are the boundary nodes around the node, including those on the far side of a wall or a
  // gap.
  SurfaceNodeMove(const Nodes<3>& nodes, const StarChanges& stars, std::int32_t node,
                  std::span<const std::int32_t> others, const InDomain& in_domain);

  // Moves the node to x on facet `on`. Afterwards change() has a subset of the new tetrahedra,
  // those of the node's own star, and a superset of the removed ones.
  void go_to(const Point<3>& x, std::int32_t on);
  const StarChange& change() const { return change_; }
  // Computes exactly the new and the removed tetrahedra. Returns false if the stars computed for
  // the old position differ from the existing ones, or if the new stars contradict each other.
  bool complete();

 private:
  // A tetrahedron with its corners sorted by id, and positively oriented.
  struct Found {
    TetrahedronNodes by_id, oriented;
    bool operator<(const Found& other) const { return by_id < other.by_id; }
    bool operator==(const Found& other) const { return by_id == other.by_id; }
  };
  // A star of the triangulation, which may extend beyond the surface.
  struct Star {
    std::vector<Found> tetrahedra;         // elements, sorted by id
    std::vector<std::int32_t> neighbours;  // including neighbours beyond the surface
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
  std::vector<Found> existing_star(std::int32_t i) const;
  std::vector<Found> existing_stars(const std::vector<std::int32_t>& centres) const;
  Found found(const TetrahedronNodes& t) const { return {stars_.by_id(t), t}; }

  const Nodes<3>& nodes_;
  const StarChanges& stars_;
  const InDomain& in_domain_;
  // The nodes within two and within three rings around the node, including itself. All neighbours
  // of a node in the second ring are in the third. `near_` also has the other boundary nodes.
  std::vector<std::int32_t> two_rings_, near_;
  std::vector<std::int32_t> centres_;  // nodes whose stars may change
  std::vector<Found> there_;           // existing tetrahedra of these stars
  // Results that do not depend on the new position: the stars before the move, and for tetrahedra
  // without the node, by id, whether they are elements.
  std::map<std::int32_t, Star> before_;
  std::map<TetrahedronNodes, bool> elements_;
  StarChange change_;
};

}  // namespace pnpbs
