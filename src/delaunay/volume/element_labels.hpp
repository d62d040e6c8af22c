// SPDX-License-Identifier: BSD-3-Clause
// Which of the tetrahedra between nodes of the surfaces are elements, where their centroids leave
// the boundary torn: where a surface is rough beside d, thin tetrahedra along it are inside or
// outside by chance, and where they meet in an edge or a node alone, or leave a node in none, no
// surface closes. There labels are changed, one after the other, until around every node the faces
// of the boundary are one disk. A function of the tetrahedra given, in whatever order they come.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace pnpbs {

struct LabelledTetrahedron {
  std::array<std::int64_t, 4> ids;  // of its nodes, ascending
  bool is_element;
  bool may_change;
  double depth;               // of its centroid below or above the surface, over its longest edge
  std::array<bool, 4> along;  // does its face opposite to each lie along one surface?

  auto operator<=>(const LabelledTetrahedron&) const = default;
};

// A node around which all tetrahedra are given that are not too wide for elements; how many disks
// the boundary should be there, and the nodes that it is joined with along feature edges.
struct LabelledNode {
  std::int64_t id;
  std::int64_t disks;
  std::vector<std::int64_t> joined;
};

// Tetrahedra with a label that is not that of their centroid.
class ChangedLabels {
 public:
  ChangedLabels() = default;
  explicit ChangedLabels(const std::vector<LabelledTetrahedron>& changed) {
    for (const LabelledTetrahedron& t : changed) labels_[t.ids] = t.is_element;
  }
  bool any() const { return !labels_.empty(); }
  // The label of this one, by its nodes' ids, ascending, if it has been changed.
  const bool* find(const std::array<std::int64_t, 4>& ids) const {
    const auto found = labels_.find(ids);
    return found == labels_.end() ? nullptr : &found->second;
  }

 private:
  std::map<std::array<std::int64_t, 4>, bool> labels_;
};

class ElementLabels {
 public:
  ElementLabels(std::vector<LabelledTetrahedron> tetrahedra,
                const std::vector<LabelledNode>& nodes);

  // Returns those whose label is now another.
  std::vector<LabelledTetrahedron> settle();
  // How far the faces of the boundary around this node are from one disk along a surface; 0: they
  // are one.
  int defects_at(std::int64_t id) const { return defects(node_of(id)); }

 private:
  struct Node {
    LabelledNode is;
    std::vector<std::size_t> tetrahedra;
  };

  const Node& node_of(std::int64_t id) const { return nodes_[node_at_.at(id)]; }
  int defects(const Node& node) const;
  int defects_around(const LabelledTetrahedron& tetrahedron) const;
  int gain(const std::vector<std::size_t>& changes);
  void change(std::size_t t);
  bool improve(const Node& node);
  bool may_change(std::size_t t) const;

  std::vector<LabelledTetrahedron> tetrahedra_;
  std::vector<char> changed_;
  std::vector<Node> nodes_;
  std::map<std::int64_t, std::size_t> node_at_;
};

}  // namespace pnpbs
