// SPDX-License-Identifier: BSD-3-Clause
// Where no change of a label, nor two at once, helps any more, and nodes still lack their disks or
// the boundary has another topology than the domain's: an iterated local search (Lourenco, Martin,
// Stuetzle 2003). In each round a label is changed near what is wrong, a walk over labels repairs
// what that has torn (WalkSAT: Selman, Kautz, Cohen, "Noise strategies for improving local search",
// 1994), and what is no better is taken back. What is random is a function of the step, so that all
// ranks go the same way.
#include <cstdlib>
#include <iterator>
#include <limits>

#include "base/mixed_hash.hpp"
#include "delaunay/volume/element_labels.hpp"

namespace pnpbs {

namespace {

constexpr int kInVain = 4;             // of so many parts of the rounds one, and the search ends
constexpr int kWalk = 100;             // steps of one
constexpr std::uint64_t kRest = 8;     // steps in which a tetrahedron is not changed back
constexpr std::uint64_t kOneInSo = 5;  // changes is any one
constexpr double kMaxDepth = 0.35;     // of centroids, over the longest edge

}  // namespace

// Of the boundary, between nodes that are given alone: a piece that comes, a bubble inside or
// outside, would make up for a handle in the characteristic.
std::int64_t ElementLabels::pieces_inside() const {
  UnionFind<std::size_t> joined(nodes_.size() + 1);  // the last one stands for all not given
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

// Around a node, mostly the one that does the least harm. None: the number of tetrahedra.
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

// Of these, or if there are none, of all.
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

// Until no more nodes than so many lack their disks.
void ElementLabels::walk(std::size_t without_disks) {
  for (int k = 0; k < kWalk && without_disks_.size() > without_disks; ++k)
    change_at_one_of(without_disks_);
}

// Single changes that help, around the nodes where labels were changed in this round.
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
    const Faults now = faults(euler_change, pieces_change);
    in_vain = now < least ? 0 : in_vain + 1;
    if (now <= least)
      least = now;
    else
      take_back();
  }
}

}  // namespace pnpbs
