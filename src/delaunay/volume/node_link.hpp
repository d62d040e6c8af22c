// SPDX-License-Identifier: BSD-3-Clause
// The link of a node: the triangles opposite to it in the tetrahedra around it. An edge of the link
// that belongs to exactly one triangle of an element is open. It corresponds to a boundary face at
// the node.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <vector>

#include "base/union_find.hpp"

namespace pnpbs {

struct LabelledTetrahedron {
  std::array<std::int64_t, 4> ids;  // Ids of its nodes in ascending order.
  bool is_element;
  bool may_change;
  double depth;               // Distance of the centroid from the surface. [longest edge]
  std::array<bool, 4> along;  // Whether the face opposite to each node lies along one surface.
  bool thin = false;          // Whether it has a dihedral angle that elements should not have.

  auto operator<=>(const LabelledTetrahedron&) const = default;
};

// A node with all tetrahedra around it given that are not too wide for elements. It has the number
// of disks that the boundary should form there, and the nodes connected to it by feature edges.
struct LabelledNode {
  std::int64_t id;
  std::int64_t disks;
  std::vector<std::int64_t> joined;
};

class NodeLink {
 public:
  // Builds the link. `around` are the indices of the tetrahedra around the node.
  NodeLink(const LabelledNode& node, const std::vector<LabelledTetrahedron>& tetrahedra,
           const std::vector<std::size_t>& around);

  // Changes the label of the tetrahedron with index `place` around the node.
  void change(std::size_t place);
  // Returns by how much the defects decrease if the labels of these tetrahedra change.
  int gain(std::initializer_list<std::size_t> places);

  // Returns a measure of how far the boundary faces around the node are from its disks along
  // surfaces. It is 0 if they are these disks.
  int defects() const { return weighed(defects_); }
  // Returns whether there are more severe defects than a face that lies along no surface.
  bool is_torn() const { return defects() >= kTorn; }
  // Returns whether the number of disks is wrong.
  bool lacks_disks() const { return defects_.disks > 0; }
  // Return the same as defects() and gain() with priority for the disks. Gains are cached until a
  // label changes, because a search evaluates the same node many times.
  int defects_of_disks() const { return disks_first(defects_); }
  int gain_of_disks(std::size_t place);
  // Returns the contribution of the node, and of its edges and faces in this tetrahedron, to six
  // times Euler's characteristic of the boundary. The other ends of an edge and the other corners
  // of a face contribute the rest.
  int euler_times_six(std::size_t place) const;
  // Returns the ids of the nodes that share a tetrahedron with this one, in ascending order.
  const std::vector<std::int64_t>& ids() const { return ids_; }
  // Calls visit(k, l) for the boundary faces, with the indices of their other corners in ids().
  template <class Visit>
  void for_faces(const Visit& visit) const {
    for (const Edge& edge : edges_)
      if (edge.used == 1) visit(edge.ends[0], edge.ends[1]);
  }

 private:
  static constexpr int kTorn = 3;  // A face along no surface counts 1.

  struct Defects {
    int disks;   // Excess or lack of pieces of open edges, and branches of these.
    int edges;   // Feature edges that are not among the open edges.
    int strays;  // Open edges whose face lies along no surface.
  };
  static int weighed(const Defects& defects) {
    return kTorn * (defects.disks + defects.edges) + defects.strays;
  }
  static int disks_first(const Defects& defects) {
    constexpr int kFirst = 10;
    return kFirst * defects.disks + kTorn * defects.edges + defects.strays;
  }

  struct Edge {
    std::array<std::size_t, 2> ends;
    bool along;         // Whether the face lies along one surface.
    std::int32_t used;  // Number of elements at the face.
  };

  static constexpr int kNotCached = std::numeric_limits<int>::min();

  void flip(std::size_t place);
  Defects counted_defects();

  std::int64_t disks_;
  std::vector<std::int64_t> ids_;
  std::vector<Edge> edges_;
  std::vector<char> is_element_;                      // Per tetrahedron around the node.
  std::vector<std::array<std::size_t, 3>> edges_of_;  // Per tetrahedron around the node.
  std::vector<std::int64_t> joined_;   // Neighbours on feature edges; -1 if in no tetrahedron here.
  std::vector<std::int32_t> open_at_;  // Number of open edges at each node of the link.
  UnionFind<std::size_t> pieces_{0};   // Nodes of the link, joined by open edges.
  Defects defects_;
  std::vector<int> gains_of_disks_;  // Per tetrahedron around the node; kNotCached if not cached.
};

}  // namespace pnpbs
