// SPDX-License-Identifier: BSD-3-Clause
// Which of the tetrahedra between nodes of the surfaces are elements, where their centroids leave
// the boundary torn: where a surface is rough beside d, thin tetrahedra along it are inside or
// outside by chance, and where they meet in an edge or a node alone, or leave a node in none, no
// surface closes. There labels are changed, one after the other, until around every node the faces
// of the boundary are one disk: first as long as one change or two at once help (settle), then,
// where that has not been enough, by a search. A function of the tetrahedra given, in whatever
// order they come.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "delaunay/volume/node_link.hpp"

namespace pnpbs {

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
  ElementLabels(std::vector<LabelledTetrahedron> tetrahedra, std::vector<LabelledNode> nodes);

  // Changes labels as long as one, or two around a node, help.
  void settle();
  // And then goes on by chance until all nodes have their disks and Euler's
  // characteristic of the boundary, and the number of its pieces, are larger by so much than they
  // were with the labels given, or that
  // has been tried for so many rounds. Nothing, if that is so
  // already.
  void search(std::int64_t euler_change, std::int64_t pieces_change, int rounds);
  // Makes thin elements none where that leaves no more defects and the same topology: two faces of
  // the boundary are exchanged for the two others of the tetrahedron.
  void drop_thin_elements();
  // Those whose label is now another.
  std::vector<LabelledTetrahedron> changed() const;
  // By how much Euler's characteristic of the boundary is larger for that.
  std::int64_t euler_change() const { return euler_change_; }
  // How far the faces of the boundary around this node are from one disk along a surface; 0: they
  // are one.
  int defects_at(std::int64_t id) const { return nodes_[node_at_.at(id)].link.defects(); }

 private:
  struct Node {
    NodeLink link;
    std::vector<std::size_t> tetrahedra;
    std::vector<std::size_t> others;  // of its link; not given: the number of nodes
    // Numbers of changes: the last around it, and the last known when none helped.
    std::uint64_t changed = 1, given_up = 0;
  };
  // Where a tetrahedron is found: at which node, as which of those around it.
  struct Corner {
    std::size_t node, place;
  };
  // What it brings to change one label: at each corner, so many defects fewer.
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
  // Less is better.
  struct Faults {
    std::size_t without_disks;
    std::int64_t topology;  // how far the characteristic is off; each piece counts 2
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

  std::vector<LabelledTetrahedron> tetrahedra_;  // as given
  std::vector<char> changed_;
  std::vector<std::vector<Corner>> corners_;  // of each tetrahedron, at nodes that are given
  std::vector<Node> nodes_;                   // by id
  std::map<std::int64_t, std::size_t> node_at_;
  std::uint64_t changes_ = 1;
  std::set<std::size_t> without_disks_, with_defects_;  // nodes
  std::int64_t defects_ = 0, euler_change_ = 0;
  std::int64_t first_pieces_ = 0;           // inside, with the labels given
  std::vector<std::uint64_t> rests_until_;  // of each tetrahedron: the step of the search
  std::vector<std::size_t> round_;          // changed in this round of it
  std::uint64_t step_ = 0;
};

}  // namespace pnpbs
