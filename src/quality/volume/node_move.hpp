// SPDX-License-Identifier: BSD-3-Clause
// Finds how the Delaunay triangulation changes if one node goes a little way. The node's new star
// comes from the nodes around. Gone are the tetrahedra of its old star, and those next to them in
// whose spheres the node is now. What is left between these and the new star is filled up with
// tetrahedra of the stars of its neighbours, face by face, until all faces match. Then every face
// is locally Delaunay, old ones and new, and with that the triangulation.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/volume/volume_star.hpp"
#include "quality/volume/star_changes.hpp"

namespace pnpbs {

class NodeMove {
 public:
  NodeMove(const Nodes<3>& nodes, const StarChanges& stars, std::int32_t node);

  // Its star at x. False if that does not close.
  bool go_to(const Point<3>& x);
  // The star's tetrahedra, and later all.
  const StarChange& change() const { return change_; }
  // The other ones made, and those gone. False if they do not fit together, because the node would
  // come to be the neighbour of others than were tried.
  bool complete();

 private:
  using Corners = StarChanges::Corners;
  VolumeNode node_at(std::int32_t i) const {
    return {i == change_.node ? change_.x : nodes_.position(i), nodes_.d(i), nodes_.id(i)};
  }
  bool wrap_star(VolumeStar& star, std::int32_t i, std::span<const std::int32_t> candidates,
                 std::vector<TetrahedronNodes>& tetrahedra) const;
  void find_gone();
  std::int32_t beyond(const TetrahedronNodes& t, std::size_t corner) const;
  bool in_sphere_now(const TetrahedronNodes& t) const;
  bool is_gone(const TetrahedronNodes& t) const;
  void add_face(const Corners& corners);
  void add_faces(const TetrahedronNodes& t, bool made);
  bool fill(const Corners& corners);

  const Nodes<3>& nodes_;
  const StarChanges& stars_;
  std::vector<std::int32_t> ring_, near_;  // neighbours now, and all that may come to be
  StarChange change_;
  std::vector<TetrahedronNodes> gone_by_id_;
  // Faces with a tetrahedron missing on the side where their corners turn counter-clockwise.
  std::vector<Corners> open_;
};

}  // namespace pnpbs
