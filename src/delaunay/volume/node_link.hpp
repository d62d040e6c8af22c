// SPDX-License-Identifier: BSD-3-Clause
// The link of a node: of each tetrahedron around it the triangle opposite to it. An edge that one
// triangle of an element has alone is a face of the boundary, as the node sees it.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <vector>

#include "base/union_find.hpp"

namespace pnpbs {

struct LabelledTetrahedron {
  std::array<std::int64_t, 4> ids;  // of its nodes, ascending
  bool is_element;
  bool may_change;
  double depth;               // of its centroid below or above the surface, over its longest edge
  std::array<bool, 4> along;  // does its face opposite to each lie along one surface?
  bool thin = false;          // has it a dihedral angle that elements should not have?

  auto operator<=>(const LabelledTetrahedron&) const = default;
};

// A node around which all tetrahedra are given that are not too wide for elements; how many disks
// the boundary should be there, and the nodes that it is joined with along feature edges.
struct LabelledNode {
  std::int64_t id;
  std::int64_t disks;
  std::vector<std::int64_t> joined;
};

class NodeLink {
 public:
  // Around the node are these of the tetrahedra.
  NodeLink(const LabelledNode& node, const std::vector<LabelledTetrahedron>& tetrahedra,
           const std::vector<std::size_t>& around);

  // Changes the label of the `place`-th tetrahedron around the node.
  void change(std::size_t place);
  // By how many there would be fewer defects if the labels of these changed.
  int gain(std::initializer_list<std::size_t> places);

  // How far the faces of the boundary around the node are from its disks along surfaces; 0: they
  // are these.
  int defects() const { return weighed(defects_); }
  // More than a face that strays.
  bool is_torn() const { return defects() >= kTorn; }
  // Are the faces not so many disks as they should be?
  bool lacks_disks() const { return defects_.disks > 0; }
  // As defects() and gain(), for who cares for the disks first. What was found is kept until a
  // label changes: a search asks the same of a node again and again.
  int defects_of_disks() const { return disks_first(defects_); }
  int gain_of_disks(std::size_t place);
  // What the node, and its edges and faces that are of this tetrahedron, add to six times Euler's
  // characteristic of the boundary: an edge adds the rest at its other end, a face at its others.
  int euler_times_six(std::size_t place) const;
  // The ids of the nodes that a tetrahedron joins to this one, ascending; and calls visit(k, l) for
  // the faces of the boundary, with the places of their other corners among these.
  const std::vector<std::int64_t>& ids() const { return ids_; }
  template <class Visit>
  void for_faces(const Visit& visit) const {
    for (const Edge& edge : edges_)
      if (edge.used == 1) visit(edge.ends[0], edge.ends[1]);
  }

 private:
  static constexpr int kTorn = 3;  // where a face that strays counts 1

  struct Defects {
    int disks;   // pieces of open edges too many or too few, and where these branch
    int edges;   // feature edges that are not among them
    int strays;  // those that lie along no surface
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
    bool along;         // does the face lie along one surface?
    std::int32_t used;  // by so many elements
  };

  static constexpr int kNotAsked = std::numeric_limits<int>::min();

  void flip(std::size_t place);
  Defects counted_defects();

  std::int64_t disks_;
  std::vector<std::int64_t> ids_;
  std::vector<Edge> edges_;
  std::vector<char> is_element_;                      // of each tetrahedron around the node
  std::vector<std::array<std::size_t, 3>> edges_of_;  // likewise
  std::vector<std::int64_t> joined_;   // by feature edges; -1: in no tetrahedron here
  std::vector<std::int32_t> open_at_;  // of each node of the link
  UnionFind<std::size_t> pieces_{0};   // likewise, joined by open edges
  Defects defects_;
  std::vector<int> gains_of_disks_;  // of each tetrahedron around the node
};

}  // namespace pnpbs
