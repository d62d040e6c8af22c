// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/growth_labels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pnpbs {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

template <int Dim>
TreePart<Dim> tree_of(const Communicator& comm, const Box<Dim>& bounds,
                      const std::vector<GrowthLeaf<Dim>>& own) {
  std::vector<LeafCell<Dim>> cells;
  std::vector<char> live;
  for (const GrowthLeaf<Dim>& leaf : own) {
    cells.push_back(leaf.cell);
    live.push_back(!leaf.outside());
  }
  return {comm, bounds, std::move(cells), std::move(live)};
}

}  // namespace

// A queue of the leaves whose label has changed since they last passed it on. All ranks process the
// leaves with values within a window above the global minimum at the same time. This is nearly the
// order of Dijkstra's algorithm, but depends on the labels only.
template <int Dim>
struct GrowthLabels<Dim>::LabelQueue {
  // Upper end of the window in units of the smallest value. A label exceeds the one that it comes
  // from by growth times the leaf width.
  static constexpr double kWindow = 1.25;
  enum State : char { idle, near, far };

  double until = -kInfinite;
  std::vector<std::int32_t> near_leaves, far_leaves;
  std::vector<State> state;

  explicit LabelQueue(const std::vector<Label>& labels) : state(labels.size(), idle) {
    for (std::size_t leaf = 0; leaf < labels.size(); ++leaf)
      if (labels[leaf].value < kInfinite) add(static_cast<std::int32_t>(leaf), labels[leaf].value);
  }

  void add(std::int32_t leaf, double value) {
    State& now = state[static_cast<std::size_t>(leaf)];
    const State next = value < until ? near : far;
    if (now == near || now == next) return;
    (next == near ? near_leaves : far_leaves).push_back(leaf);
    now = next;
  }

  // Selects the next leaves and returns whether there are any on any rank. Collective.
  bool next(const Communicator& comm, const std::vector<Label>& labels) {
    if (comm.allreduce_max(!near_leaves.empty()) > 0) return true;
    double min = kInfinite;
    std::erase_if(far_leaves, [this](std::int32_t leaf) {
      return state[static_cast<std::size_t>(leaf)] != far;
    });
    for (const std::int32_t leaf : far_leaves)
      min = std::min(min, labels[static_cast<std::size_t>(leaf)].value);
    min = -comm.allreduce_max(-min);
    until = kWindow * min;
    for (const std::int32_t leaf : far_leaves) {
      const double value = labels[static_cast<std::size_t>(leaf)].value;
      if (value < until) add(leaf, value);
    }
    return min < kInfinite;
  }

  // Removes and returns the selected leaves of this rank.
  std::vector<std::int32_t> take() {
    for (const std::int32_t leaf : near_leaves) state[static_cast<std::size_t>(leaf)] = idle;
    return std::exchange(near_leaves, {});
  }
};

template <int Dim>
GrowthLabels<Dim>::GrowthLabels(const Communicator& comm, const LineOfSight<Dim>& ways,
                                const std::vector<GrowthLeaf<Dim>>& own,
                                const GrowthRule<Dim>& rule, const Beat& beat)
    : rule_(rule), tree_(tree_of(comm, ways.bounds(), own)) {
  using Side = typename GrowthLeaf<Dim>::Side;
  for (const GrowthLeaf<Dim>& leaf : own) {
    spots_.push_back({leaf.place, leaf.placed,
                      leaf.placed && (leaf.side == Side::inside || ways.inside(leaf.place)),
                      leaf.side == Side::crossed});
    labels_.push_back(label_at<Dim>(leaf.place, leaf.source, rule_));
  }
  spots_.resize(static_cast<std::size_t>(tree_.count()));
  labels_.resize(spots_.size());
  fill_ghosts(comm, tree_.border(), spots_);
  fill_ghosts(comm, tree_.border(), labels_);
  settle(comm, ways, beat);
}

// Runs rounds: in each, all selected leaves of all ranks pass on their labels simultaneously.
template <int Dim>
void GrowthLabels<Dim>::settle(const Communicator& comm, const LineOfSight<Dim>& ways,
                               const Beat& beat) {
  LabelQueue waiting(labels_);
  std::vector<Label> copies_before;
  while (waiting.next(comm, labels_)) {
    std::vector<std::int32_t> changed;
    hand_on(ways, waiting.take(), changed, beat);
    copies_before.assign(labels_.begin() + tree_.own_count(), labels_.end());
    fill_ghosts(comm, tree_.border(), labels_);
    for (std::int64_t copy = tree_.own_count(); copy < tree_.count(); ++copy)
      if (label(copy) < copies_before[static_cast<std::size_t>(copy - tree_.own_count())])
        changed.push_back(static_cast<std::int32_t>(copy));
    for (const std::int32_t leaf : changed) waiting.add(leaf, label(leaf).value);
  }
}

// Returns whether the segment from a source to the representative point of a leaf lies in the
// domain. A segment between two points of the boundary may lie outside without crossing a facet.
template <int Dim>
bool GrowthLabels<Dim>::open_way(const LineOfSight<Dim>& ways, const Point<Dim>& from,
                                 const LeafPoint& to) const {
  if (!to.placed || !ways.open(from, to.place)) return false;
  return to.inside || ways.inside(middle_of<Dim>(from, to.place));
}

// Passes labels on to own leaves. Copies receive those that their owners computed.
template <int Dim>
void GrowthLabels<Dim>::hand_on(const LineOfSight<Dim>& ways,
                                const std::vector<std::int32_t>& leaves,
                                std::vector<std::int32_t>& changed, const Beat& beat) {
  constexpr std::size_t kBetweenBeats = 4096;
  std::vector<Label> handed;  // labels before any of them changes
  for (const std::int32_t leaf : leaves) handed.push_back(label(leaf));
  for (std::size_t k = 0; k < leaves.size(); ++k) {
    if (k % kBetweenBeats == 0) beat();
    const LeafPoint& from = spot(leaves[k]);
    for (const std::int32_t other : tree_.touching_leaves(leaves[k])) {
      if (!tree_.owns(other)) continue;
      const LeafPoint& to = spot(other);
      Label& there = labels_[static_cast<std::size_t>(other)];
      Label offer = label_at<Dim>(to.place, handed[k].source, rule_);
      if (!(offer < there)) continue;  // a longer path does not help either
      if (!open_way(ways, handed[k].source.x, to)) {
        if (!from.placed) continue;
        offer = label_at<Dim>(to.place, {from.place, handed[k].value}, rule_);
        if (!(offer < there)) continue;
      }
      there = offer;
      changed.push_back(other);
    }
  }
}

template <int Dim>
double GrowthLabels<Dim>::limit_at(const LineOfSight<Dim>& ways, const Point<Dim>& x) const {
  const std::int64_t leaf = tree_.leaf_at(x);
  if (!tree_.owns(leaf)) return kInfinite;
  double limit = rule_.limit(label(leaf).source, x);
  for (const std::int32_t other : tree_.touching_leaves(leaf)) {
    const GrowthSource<Dim>& source = label(other).source;
    const double by_other = rule_.limit(source, x);
    if (!(by_other < limit)) continue;
    const bool beside_boundary = spot(leaf).crossed || spot(other).crossed;
    if (!beside_boundary || ways.open(x, source.x)) limit = by_other;
  }
  return limit;
}

template class GrowthLabels<2>;
template class GrowthLabels<3>;

}  // namespace pnpbs
