// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/volume/element_labels.hpp"

#include <algorithm>
#include <initializer_list>
#include <tuple>
#include <utility>

namespace pnpbs {

namespace {

int sum_of(const std::array<int, 4>& gains) { return gains[0] + gains[1] + gains[2] + gains[3]; }

}  // namespace

ElementLabels::ElementLabels(std::vector<LabelledTetrahedron> tetrahedra,
                             std::vector<LabelledNode> nodes)
    : tetrahedra_(std::move(tetrahedra)) {
  std::ranges::sort(tetrahedra_);
  tetrahedra_.erase(std::unique(tetrahedra_.begin(), tetrahedra_.end()), tetrahedra_.end());
  changed_.assign(tetrahedra_.size(), 0);
  corners_.resize(tetrahedra_.size());
  std::ranges::sort(nodes, {}, &LabelledNode::id);
  for (std::size_t n = 0; n < nodes.size(); ++n) node_at_[nodes[n].id] = n;
  std::vector<std::vector<std::size_t>> around(nodes.size());
  for (std::size_t t = 0; t < tetrahedra_.size(); ++t)
    for (const std::int64_t id : tetrahedra_[t].ids)
      if (const auto found = node_at_.find(id); found != node_at_.end()) {
        corners_[t].push_back({found->second, around[found->second].size()});
        around[found->second].push_back(t);
      }
  for (std::size_t n = 0; n < nodes.size(); ++n)
    nodes_.push_back({NodeLink(nodes[n], tetrahedra_, around[n]), around[n], {}});
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const NodeLink& link = nodes_[n].link;
    for (const std::int64_t id : link.ids()) {
      const auto found = node_at_.find(id);
      nodes_[n].others.push_back(found == node_at_.end() ? nodes.size() : found->second);
    }
    defects_ += link.defects();
    if (link.lacks_disks()) without_disks_.insert(n);
    if (link.defects() > 0) with_defects_.insert(n);
  }
  first_pieces_ = pieces_inside();
}

// What is surely inside or outside stays; so does what has a node around which not all is known.
bool ElementLabels::may_change(std::size_t t, double max_depth) const {
  return tetrahedra_[t].may_change && tetrahedra_[t].depth < max_depth && corners_[t].size() == 4;
}

// Has a label changed around one of their nodes?
bool ElementLabels::may_help(const std::vector<std::size_t>& free, std::uint64_t since) const {
  return std::ranges::any_of(free, [&](std::size_t t) {
    return std::ranges::any_of(
        corners_[t], [&](const Corner& corner) { return nodes_[corner.node].changed > since; });
  });
}

ElementLabels::Change ElementLabels::change_of(std::size_t t) {
  Change change{t, {}};
  for (std::size_t k = 0; k < 4; ++k) {
    const Corner& corner = corners_[t][k];
    change.gains[k] = nodes_[corner.node].link.gain({corner.place});
  }
  return change;
}

// Of both at once: another one only at nodes that both have. Less than `worth` may be less still.
int ElementLabels::gain(const Change& one, const Change& other, int worth) {
  int gain = sum_of(one.gains) + sum_of(other.gains), most = 0;
  std::array<std::array<Corner, 2>, 4> shared;
  std::size_t count = 0;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t l = 0; l < 4; ++l) {
      const Corner &a = corners_[one.t][k], &b = corners_[other.t][l];
      if (a.node != b.node) continue;
      shared[count++] = {a, b};
      gain -= one.gains[k] + other.gains[l];
      most += nodes_[a.node].link.defects();
    }
  if (gain + most < worth) return gain + most;
  for (std::size_t k = 0; k < count; ++k)
    gain += nodes_[shared[k][0].node].link.gain({shared[k][0].place, shared[k][1].place});
  return gain;
}

// What helps most, the change of one tetrahedron or, if that does not and the node has no disk, of
// two around it; of equals what is nearest to the surface.
std::vector<std::size_t> ElementLabels::best_changes(const Node& node,
                                                     const std::vector<std::size_t>& free) {
  std::tuple<int, double> best{0, 0};
  std::vector<std::size_t> changes;
  const auto consider = [&](int gain, double depth, std::initializer_list<std::size_t> those) {
    const std::tuple<int, double> here{gain, -depth};
    if (gain <= 0 || (!changes.empty() && here <= best)) return;
    best = here;
    changes = those;
  };
  std::vector<Change> alone;
  for (const std::size_t t : free) {
    alone.push_back(change_of(t));
    consider(sum_of(alone.back().gains), tetrahedra_[t].depth, {t});
  }
  if (!changes.empty() || !node.link.is_torn()) return changes;
  for (std::size_t k = 0; k < free.size(); ++k)
    for (std::size_t l = 0; l < k; ++l)
      consider(gain(alone[k], alone[l], std::max(1, std::get<0>(best))),
               tetrahedra_[free[k]].depth + tetrahedra_[free[l]].depth, {free[k], free[l]});
  return changes;
}

bool ElementLabels::improve(Node& node) {
  constexpr double kMaxDepth = 0.2;
  std::vector<std::size_t> free;
  for (const std::size_t t : node.tetrahedra)
    if (may_change(t, kMaxDepth)) free.push_back(t);
  if (!may_help(free, node.given_up)) return false;
  const std::vector<std::size_t> changes = best_changes(node, free);
  if (changes.empty()) node.given_up = changes_;
  if (!changes.empty()) ++changes_;
  for (const std::size_t t : changes) change(t);
  return !changes.empty();
}

// Of its nodes, edges and faces.
int ElementLabels::euler_times_six(std::size_t t) const {
  int sum = 0;
  for (const Corner& corner : corners_[t])
    sum += nodes_[corner.node].link.euler_times_six(corner.place);
  return sum;
}

void ElementLabels::change(std::size_t t) {
  const auto put = [](std::set<std::size_t>& nodes, std::size_t n, bool in) {
    if (in)
      nodes.insert(n);
    else
      nodes.erase(n);
  };
  const int before = euler_times_six(t);
  changed_[t] = changed_[t] == 0;
  for (const Corner& corner : corners_[t]) {
    Node& node = nodes_[corner.node];
    defects_ -= node.link.defects();
    node.link.change(corner.place);
    node.changed = changes_;
    defects_ += node.link.defects();
    put(without_disks_, corner.node, node.link.lacks_disks());
    put(with_defects_, corner.node, node.link.defects() > 0);
  }
  euler_change_ += (euler_times_six(t) - before) / 6;
}

void ElementLabels::settle() {
  bool any = true;
  while (any) {
    any = false;
    for (Node& node : nodes_)
      while (node.link.defects() > 0 && improve(node)) any = true;
  }
}

std::vector<LabelledTetrahedron> ElementLabels::changed() const {
  std::vector<LabelledTetrahedron> result;
  for (std::size_t t = 0; t < tetrahedra_.size(); ++t) {
    if (changed_[t] == 0) continue;
    result.push_back(tetrahedra_[t]);
    result.back().is_element = !tetrahedra_[t].is_element;
  }
  return result;
}

}  // namespace pnpbs
