// SPDX-License-Identifier: BSD-3-Clause
// Labels that say which tetrahedra between nodes of surfaces are elements, where labels by
// centroids do not result in a closed boundary. Where a surface is rough compared to d, thin
// tetrahedra along it are inside or outside by chance. If they meet only in an edge or a node, or a
// node is in no element, the boundary is not a closed surface.
// Labels are changed one after the other until the boundary faces around every node form one disk.
// Defects measure how far they are from it.
// At first a change of one or two labels at once is tried (settle), then a search. The result is a
// function of the given tetrahedra and does not depend on their order.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "delaunay/volume/node_link.hpp"

namespace pnpbs {

// Tetrahedra with a label that differs from that of their centroid.
class ChangedLabels {
 public:
  ChangedLabels() = default;
  explicit ChangedLabels(const std::vector<LabelledTetrahedron>& changed) {
    for (const LabelledTetrahedron& t : changed) labels_[t.ids] = t.is_element;
  }
  bool any() const { return !labels_.empty(); }
  // Returns the label of a tetrahedron if it has been changed, or null. `ids` are those of its
  // nodes in ascending order.
  const bool* find(const std::array<std::int64_t, 4>& ids) const {
    const auto found = labels_.find(ids);
    return found == labels_.end() ? nullptr : &found->second;
  }

 private:
  std::map<std::array<std::int64_t, 4>, bool> labels_;
};

class ElementLabels {
 public:
  ElementLabels(std::vector<LabelledTetrahedron> tetrahedra, std::vector<LabelledNode> nodes);

  // Changes labels as long as changing one, or two around a node, reduces the defects.
  void settle();
  // Continues with a randomized search. It ends when all nodes have their disks, and Euler's
  // characteristic and the number of pieces of the boundary exceed those of the given labels by
  // `euler_change` and `pieces_change`, or after `rounds` rounds. It does nothing if this is
  // already so.
  void search(std::int64_t euler_change, std::int64_t pieces_change, int rounds);
  // Removes thin elements where that neither adds defects nor changes the topology: two faces of
  // the boundary are exchanged for the two others of the tetrahedron.
  void drop_thin_elements();
  // Returns the tetrahedra whose label has changed, with their new label.
  std::vector<LabelledTetrahedron> changed() const;
  // Returns the increase of Euler's characteristic of the boundary due to the changes.
  std::int64_t euler_change() const { return euler_change_; }
  // Returns a measure of how far the boundary faces around a node are from one disk along a
  // surface. It is 0 if they are one.
  int defects_at(std::int64_t id) const { return nodes_[node_at_.at(id)].link.defects(); }

 private:
  struct Node {
    NodeLink link;
    std::vector<std::size_t> tetrahedra;
    std::vector<std::size_t> others;  // Nodes of its link; the number of nodes if not given.
    // Counts of changes: at the last change around the node, and when improve() last found none
    // that helps.
    std::uint64_t changed = 1, given_up = 0;
  };
  // A node of a tetrahedron, and the index of the tetrahedron among those around the node.
  struct Corner {
    std::size_t node, place;
  };
  // Change of one label, and by how much it reduces the defects at each corner.
  struct Change {
    std::size_t t;
    std::array<int, 4> gains;
  };

  Change change_of(std::size_t t);
  int gain(const Change& one, const Change& other, int worth);
  bool may_change(std::size_t t, double max_depth) const;
  bool may_help(const std::vector<std::size_t>& free, std::uint64_t since) const;
  std::vector<std::size_t> best_changes(const Node& node, const std::vector<std::size_t>& free);
  bool improve(Node& node);
  bool is_element(std::size_t t) const { return tetrahedra_[t].is_element != (changed_[t] != 0); }
  void change(std::size_t t);
  int euler_times_six(std::size_t t) const;

  // --- the search ---

  // Remaining faults; less is better.
  struct Faults {
    std::size_t without_disks;
    std::int64_t topology;  // Deviation of the characteristic; each piece counts 2.
    std::int64_t defects;

    auto operator<=>(const Faults&) const = default;
    bool whole() const { return without_disks == 0 && topology == 0; }
  };
  std::int64_t pieces_inside() const;
  Faults faults(std::int64_t euler_change, std::int64_t pieces_change) const;
  int gain_of_disks(std::size_t t);
  std::size_t tetrahedron_to_change(std::size_t n, std::uint64_t random);
  void change_in_search(std::size_t t);
  void change_at_one_of(const std::set<std::size_t>& nodes);
  void walk(std::size_t without_disks);
  void descend();
  void take_back();

  std::vector<LabelledTetrahedron> tetrahedra_;  // The given ones.
  std::vector<char> changed_;
  std::vector<std::vector<Corner>> corners_;  // Corners of each tetrahedron at given nodes.
  std::vector<Node> nodes_;                   // Ascending by id.
  std::map<std::int64_t, std::size_t> node_at_;
  std::uint64_t changes_ = 1;
  std::set<std::size_t> without_disks_, with_defects_;  // Indices of nodes.
  std::int64_t defects_ = 0, euler_change_ = 0;
  std::int64_t first_pieces_ = 0;  // Result of pieces_inside() for the given labels.
  // Per tetrahedron: step of the search until which it must not change back.
  std::vector<std::uint64_t> rests_until_;
  std::vector<std::size_t> round_;  // Tetrahedra changed in this round.
  std::uint64_t step_ = 0;
};

}  // namespace pnpbs
