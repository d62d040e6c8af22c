// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/volume/element_labels.hpp"

#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <tuple>
#include <utility>

#include "base/mixed_hash.hpp"

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

// Returns whether the label may change. Tetrahedra that are certainly inside or outside keep their
// label, and so do those with a node around which not all tetrahedra are given.
bool ElementLabels::may_change(std::size_t t, double max_depth) const {
  return tetrahedra_[t].may_change && tetrahedra_[t].depth < max_depth && corners_[t].size() == 4;
}

// Returns whether a label has changed around one of their nodes after `since`.
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

// Returns the gain of both changes at once, which is not the sum of both only at common nodes. If
// it is less than `worth`, an upper bound may be returned.
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

// Returns the changes with the largest gain: that of one tetrahedron or, if none helps and the
// boundary is torn at the node, of two around it. Of equal gains, the one nearest to the surface is
// returned.
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

// Returns six times the contribution of the tetrahedron's nodes, edges and faces to Euler's
// characteristic.
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

// The search: if changing one or two labels no longer helps, but nodes lack their disks or the
// boundary has another topology than the domain, an iterated local search follows (Lourenco,
// Martin, Stuetzle 2003). Each round changes a label near a fault and repairs the consequences by a
// walk over labels (WalkSAT: Selman, Kautz, Cohen, "Noise strategies for improving local search",
// 1994). A result that is not better is reverted. Random numbers are a function of the step, so
// that all ranks search alike.

namespace {

constexpr int kInVain = 4;          // The search ends after 1 / kInVain of the rounds without gain.
constexpr int kWalk = 100;          // Maximum number of steps of a walk.
constexpr std::uint64_t kRest = 8;  // Steps during which a tetrahedron is not changed back.
constexpr std::uint64_t kOneInSo = 5;  // One in so many changes is random.
constexpr double kMaxDepth = 0.35;     // Maximum depth of centroids. [longest edge]

}  // namespace

// Returns the number of pieces of the boundary that contain given nodes only. A new piece, i.e. a
// bubble inside or outside, would compensate for a handle in the characteristic.
std::int64_t ElementLabels::pieces_inside() const {
  // The last element represents all nodes that are not given.
  UnionFind<std::size_t> joined(nodes_.size() + 1);
  std::vector<std::size_t> on_boundary;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    bool any = false;
    nodes_[n].link.for_faces([&](std::size_t a, std::size_t b) {
      any = true;
      joined.join(n, nodes_[n].others[a]);
      joined.join(n, nodes_[n].others[b]);
    });
    if (any) on_boundary.push_back(n);
  }
  std::set<std::size_t> pieces;
  for (const std::size_t n : on_boundary) pieces.insert(joined.root(n));
  pieces.erase(joined.root(nodes_.size()));
  return std::ssize(pieces);
}

ElementLabels::Faults ElementLabels::faults(std::int64_t euler_change,
                                            std::int64_t pieces_change) const {
  const std::int64_t pieces =
      without_disks_.empty() ? pieces_inside() - first_pieces_ - pieces_change : 0;
  const std::int64_t handles = euler_change_ - euler_change - 2 * pieces;
  return {without_disks_.size(), std::abs(handles) + 2 * std::abs(pieces), defects_};
}

int ElementLabels::gain_of_disks(std::size_t t) {
  int gain = 0;
  for (const Corner& corner : corners_[t])
    gain += nodes_[corner.node].link.gain_of_disks(corner.place);
  return gain;
}

// Returns a tetrahedron around node n, usually the one whose change does the least harm. Returns
// the number of tetrahedra if none may be changed.
std::size_t ElementLabels::tetrahedron_to_change(std::size_t n, std::uint64_t random) {
  std::vector<std::size_t> free;
  for (const std::size_t t : nodes_[n].tetrahedra)
    if (may_change(t, kMaxDepth) && step_ > rests_until_[t]) free.push_back(t);
  if (free.empty()) return tetrahedra_.size();
  if (random % kOneInSo == 0) return free[random / kOneInSo % free.size()];
  std::size_t best = free[0];
  int most = std::numeric_limits<int>::min();
  for (const std::size_t t : free) {
    const int gain = gain_of_disks(t);
    if (gain <= most) continue;
    most = gain;
    best = t;
  }
  return best;
}

void ElementLabels::change_in_search(std::size_t t) {
  change(t);
  round_.push_back(t);
}

// Changes a label at one of these nodes, or at one of all nodes if `nodes` is empty.
void ElementLabels::change_at_one_of(const std::set<std::size_t>& nodes) {
  const std::uint64_t random = mixed(++step_);
  const std::size_t k = random % (nodes.empty() ? nodes_.size() : nodes.size());
  const std::size_t n =
      nodes.empty() ? k : *std::next(nodes.begin(), static_cast<std::ptrdiff_t>(k));
  const std::size_t t = tetrahedron_to_change(n, mixed(random));
  if (t == tetrahedra_.size()) return;
  change_in_search(t);
  rests_until_[t] = step_ + kRest;
}

// Walks until at most `without_disks` nodes lack their disks.
void ElementLabels::walk(std::size_t without_disks) {
  for (int k = 0; k < kWalk && without_disks_.size() > without_disks; ++k)
    change_at_one_of(without_disks_);
}

// Makes single changes that help, around the nodes where labels were changed in this round.
void ElementLabels::descend() {
  std::set<std::size_t> nodes;
  for (const std::size_t t : round_)
    for (const Corner& corner : corners_[t]) nodes.insert(corner.node);
  for (const std::size_t n : nodes)
    for (const std::size_t t : nodes_[n].tetrahedra)
      if (may_change(t, kMaxDepth) && gain_of_disks(t) > 0) change_in_search(t);
}

void ElementLabels::take_back() {
  for (; !round_.empty(); round_.pop_back()) change(round_.back());
}

void ElementLabels::search(std::int64_t euler_change, std::int64_t pieces_change, int rounds) {
  rests_until_.assign(tetrahedra_.size(), 0);
  Faults least = faults(euler_change, pieces_change);
  int in_vain = 0;
  for (int round = 0; round < rounds && in_vain < rounds / kInVain; ++round) {
    if (least.whole() || nodes_.empty()) break;
    round_.clear();
    change_at_one_of(round % 2 == 0 && !without_disks_.empty() ? without_disks_ : with_defects_);
    walk(least.without_disks);
    if (without_disks_.size() <= least.without_disks) descend();
    if (round_.empty()) {  // No label could be changed.
      ++in_vain;
      continue;
    }
    const Faults now = faults(euler_change, pieces_change);
    in_vain = now < least ? 0 : in_vain + 1;
    if (now <= least)
      least = now;
    else
      take_back();
  }
}

// Terminates because each change removes one thin element.
void ElementLabels::drop_thin_elements() {
  for (bool any = true; any;) {
    any = false;
    for (std::size_t t = 0; t < tetrahedra_.size(); ++t) {
      if (!tetrahedra_[t].thin || !is_element(t) || !may_change(t, kMaxDepth)) continue;
      const auto state = [&] { return std::tuple(without_disks_.size(), defects_); };
      const auto before = state();
      const std::int64_t euler = euler_change_;
      change(t);
      if (state() <= before && euler_change_ == euler)
        any = true;
      else
        change(t);
    }
  }
}

}  // namespace pnpbs
