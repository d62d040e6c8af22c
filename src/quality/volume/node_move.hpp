// SPDX-License-Identifier: BSD-3-Clause
// Change of the Delaunay triangulation when one inner node moves a short way. The node's new star
// is computed from the nodes around it. The removed tetrahedra are those of its old star, and
// adjacent ones whose circumspheres contain the new position. The gap between these and the new
// star is filled with tetrahedra from the stars of the node's neighbours, face by face, until all
// faces match. Then every face is locally Delaunay, and therefore the whole triangulation is.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/volume/volume_star.hpp"
#include "quality/volume/star_changes.hpp"

namespace pnpbs {

// The moves of one node that are tried one after another. `nodes` and `stars` must outlive this
// object.
class NodeMove {
 public:
  NodeMove(const Nodes<3>& nodes, const StarChanges& stars, std::int32_t node);

  // Computes the node's star at x. Returns false if the star is not closed.
  bool go_to(const Point<3>& x);
  // Returns the change: after go_to() the tetrahedra of the new star only, after complete() all
  // tetrahedra made and removed.
  const StarChange& change() const { return change_; }
  // Computes the remaining tetrahedra. Returns false if they do not match, because the node would
  // become a neighbour of nodes that were not considered.
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
  std::vector<std::int32_t> ring_, near_;  // current neighbours, and all candidates for neighbours
  StarChange change_;
  // The removed tetrahedra with corners sorted by id.
  std::vector<TetrahedronNodes> gone_by_id_;
  // Faces without a tetrahedron on the side from which their corners turn counter-clockwise.
  std::vector<Corners> open_;
};

}  // namespace pnpbs
