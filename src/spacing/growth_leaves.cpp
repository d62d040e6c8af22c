// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/growth_leaves.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/lattice.hpp"
#include "base/point_text.hpp"
#include "method/constants.hpp"
#include "spacing/dips.hpp"
#include "spacing/sized_tree.hpp"
#include "tree/cell_samples.hpp"

namespace pnpbs {

template <int Dim>
GrowthLeaves<Dim>::GrowthLeaves(const Communicator& comm, const LineOfSight<Dim>& ways,
                                const GrowthRule<Dim>& rule, const NodeLimit& limit,
                                std::vector<Point<Dim>> places)
    : comm_(comm), ways_(ways), rule_(rule), limit_(limit), points_(ways, std::move(places)) {
  if (comm.rank() != 0) return;
  leaves_.emplace_back();
  look_at_domain(leaves_.front());
}

template <int Dim>
void GrowthLeaves<Dim>::look_at_domain(GrowthLeaf<Dim>& leaf) const {
  using Side = typename GrowthLeaf<Dim>::Side;
  if (leaf.side == Side::crossed) leaf.side = ways_.side_of(points_.box_of(leaf.cell));
  if (leaf.outside()) {
    leaf.open = leaf.fresh = false;
    return;
  }
  if (leaf.has_nodes) {
    leaf.has_nodes = false;
    points_.for_nodes_in(leaf.cell, [&](std::int64_t) { leaf.has_nodes = true; });
  }
  leaf.place = middle_of<Dim>(points_.box_of(leaf.cell));
  leaf.placed = true;
  leaf.sliver = Dim == 3 && leaf.side == Side::crossed &&
                !samples_suffice<Dim>(points_.samples_inside(leaf.cell));
  if (leaf.side == Side::inside || ways_.inside(leaf.place)) return;
  std::vector<Point<Dim>> points;
  points_.add_points(leaf, points);
  leaf.placed = !points.empty();
  if (leaf.placed) leaf.place = points.front();
}

template <int Dim>
template <class Wanted>
typename GrowthLeaves<Dim>::Samples GrowthLeaves<Dim>::samples_in(const Wanted& wanted) const {
  return samples_in(wanted, [this](const GrowthLeaf<Dim>& leaf, std::vector<Point<Dim>>& points) {
    points_.add_points(leaf, points);
  });
}

template <int Dim>
template <class Wanted, class Add>
typename GrowthLeaves<Dim>::Samples GrowthLeaves<Dim>::samples_in(const Wanted& wanted,
                                                                  const Add& add) const {
  Samples samples;
  for (std::size_t leaf = 0; leaf < leaves_.size(); ++leaf) {
    if (!wanted(leaves_[leaf])) continue;
    samples.leaves.push_back(leaf);
    add(leaves_[leaf], samples.x);
    samples.first.push_back(samples.x.size());
  }
  samples.d.resize(samples.x.size());
  return samples;
}

template <int Dim>
void GrowthLeaves<Dim>::take_range(const Samples& samples) {
  for (std::size_t k = 0; k < samples.leaves.size(); ++k) {
    if (samples.first[k] == samples.first[k + 1]) continue;
    GrowthLeaf<Dim>& leaf = leaves_[samples.leaves[k]];
    const auto [min, max] = std::minmax_element(samples.d.data() + samples.first[k],
                                                samples.d.data() + samples.first[k + 1]);
    leaf.min = *min;
    leaf.max = *max;
  }
}

template <int Dim>
typename GrowthLeaves<Dim>::Samples GrowthLeaves<Dim>::samples_in_slivers() const {
  return samples_in([](const GrowthLeaf<Dim>& leaf) { return leaf.open && leaf.sliver; },
                    [this](const GrowthLeaf<Dim>& leaf, std::vector<Point<Dim>>& points) {
                      points_.add_points_in_sliver(leaf, points);
                    });
}

// Moves each sample to the nearest point inside its leaf's cell.
template <int Dim>
void GrowthLeaves<Dim>::move_into_cells(Samples& samples) const {
  constexpr double kFromFace = 1e-9;  // [side of the cell]
  for (std::size_t k = 0; k < samples.leaves.size(); ++k) {
    const Box<Dim> box = points_.box_of(leaves_[samples.leaves[k]].cell);
    for (std::size_t s = samples.first[k]; s < samples.first[k + 1]; ++s)
      for (int axis = 0; axis < Dim; ++axis) {
        const double room = kFromFace * (box.high[axis] - box.low[axis]);
        samples.x[s][axis] =
            std::clamp(samples.x[s][axis], box.low[axis] + room, box.high[axis] - room);
      }
  }
}

// Samples d at the centres of adjacent cells. Where d jumps between two leaves, the samples inside
// do not show how close the jump is to their common face, and the source of a leaf may be far from
// it.
template <int Dim>
void GrowthLeaves<Dim>::sample_adjacent_cells(const SpacingEvaluator<Dim>& raw) {
  Samples beside = samples_in([](const GrowthLeaf<Dim>& leaf) { return leaf.open; },
                              [this](const GrowthLeaf<Dim>& leaf, std::vector<Point<Dim>>& points) {
                                points_.add_points_beside(leaf, points);
                              });
  raw(std::ssize(beside.x), beside.x.data(), beside.d.data());
  for (std::size_t k = 0; k < beside.leaves.size(); ++k) {
    GrowthLeaf<Dim>& leaf = leaves_[beside.leaves[k]];
    leaf.max_beside = leaf.max;
    for (std::size_t s = beside.first[k]; s < beside.first[k + 1]; ++s)
      leaf.max_beside = std::max(leaf.max_beside, beside.d[s]);
  }
}

// Lowers the smallest d of a leaf to the bound by known values near it.
template <int Dim>
void GrowthLeaves<Dim>::expect_known(const Samples& samples, const GrowthSources<Dim>& known) {
  for (std::size_t k = 0; k < samples.leaves.size(); ++k) {
    GrowthLeaf<Dim>& leaf = leaves_[samples.leaves[k]];
    for (std::size_t s = samples.first[k]; s < samples.first[k + 1]; ++s)
      leaf.min = known.limit(samples.x[s], leaf.min);
  }
}

template <int Dim>
void GrowthLeaves<Dim>::take_sources(const Samples& samples) {
  for (std::size_t k = 0; k < samples.leaves.size(); ++k) {
    GrowthLeaf<Dim>& leaf = leaves_[samples.leaves[k]];
    leaf.fresh = false;
    GrowthLabel<Dim> best = label_at<Dim>(leaf.place, leaf.source, rule_);
    for (std::size_t s = samples.first[k]; s < samples.first[k + 1]; ++s)
      best = std::min(best, label_at<Dim>(leaf.place, {samples.x[s], samples.d[s]}, rule_));
    leaf.source = best.source;
  }
}

template <int Dim>
bool GrowthLeaves<Dim>::any_open() const {
  const bool any = std::any_of(leaves_.begin(), leaves_.end(),
                               [](const GrowthLeaf<Dim>& leaf) { return leaf.open; });
  return comm_.allreduce_max(any) > 0;
}

template <int Dim>
void GrowthLeaves<Dim>::refine(const SpacingEvaluator<Dim>& raw,
                               const std::vector<GrowthSource<Dim>>& known) {
  const GrowthSources<Dim> expected(known, kSeenFromSamples);
  while (any_open()) {
    spread_evenly(comm_, leaves_);
    Samples samples = samples_in([](const GrowthLeaf<Dim>& leaf) { return leaf.open; });
    raw(std::ssize(samples.x), samples.x.data(), samples.d.data());
    take_range(samples);
    Samples in_slivers = samples_in_slivers();
    raw(std::ssize(in_slivers.x), in_slivers.x.data(), in_slivers.d.data());
    take_range(in_slivers);
    if constexpr (Dim == 3) sample_adjacent_cells(raw);
    expect_known(samples, expected);
    take_sources(samples);
    require_small_node_set();
    split_open(rule_.growth);
  }
  spread_evenly(comm_, leaves_);
}

template <int Dim>
bool GrowthLeaves<Dim>::fit(const SpacingEvaluator<Dim>& limited) {
  bool any = false;
  for (GrowthLeaf<Dim>& leaf : leaves_) leaf.open = !leaf.outside();
  while (any_open()) {
    Samples samples = samples_in([](const GrowthLeaf<Dim>& leaf) { return leaf.open; });
    limited(std::ssize(samples.x), samples.x.data(), samples.d.data());
    take_range(samples);
    Samples in_slivers = samples_in_slivers();
    move_into_cells(in_slivers);
    limited(std::ssize(in_slivers.x), in_slivers.x.data(), in_slivers.d.data());
    take_range(in_slivers);
    require_small_node_set();
    any = split_open(0) || any;
  }
  return comm_.allreduce_max(any) > 0;
}

template <int Dim>
bool GrowthLeaves<Dim>::find_dips(const SpacingEvaluator<Dim>& raw,
                                  const SpacingEvaluator<Dim>& limited) {
  Samples probes =
      samples_in([](const GrowthLeaf<Dim>& leaf) { return !leaf.outside() && !leaf.probed; },
                 [this](const GrowthLeaf<Dim>& leaf, std::vector<Point<Dim>>& points) {
                   points_.add_probes(leaf, points);
                 });
  std::vector<double> limits(probes.x.size());
  raw(std::ssize(probes.x), probes.x.data(), probes.d.data());
  limited(std::ssize(probes.x), probes.x.data(), limits.data());
  for (GrowthLeaf<Dim>& leaf : leaves_) leaf.probed = true;
  const std::vector<Point<Dim>> dips = dips_over_ranks<Dim>(comm_, probes.x, probes.d, limits);
  if (dips.empty()) return false;
  take_places(dips);
  refine(raw, {});
  return true;
}

// Adds sample points, and reopens the leaves that contain them, as these may have to be split.
template <int Dim>
void GrowthLeaves<Dim>::take_places(const std::vector<Point<Dim>>& places) {
  points_.add_places(places);
  for (GrowthLeaf<Dim>& leaf : leaves_) {
    if (leaf.outside()) continue;
    const std::int64_t of_boundary = ways_.node_count();
    points_.for_nodes_in(leaf.cell, [&](std::int64_t n) {
      leaf.has_nodes = true;
      leaf.open = leaf.open || n >= of_boundary;
    });
  }
}

template <int Dim>
void GrowthLeaves<Dim>::look_into_new(const SpacingEvaluator<Dim>& raw) {
  Samples samples = samples_in([](const GrowthLeaf<Dim>& leaf) { return leaf.fresh; });
  raw(std::ssize(samples.x), samples.x.data(), samples.d.data());
  take_sources(samples);
  spread_evenly(comm_, leaves_);
}

template <int Dim>
bool GrowthLeaves<Dim>::too_wide(const GrowthLeaf<Dim>& leaf, double steepest) const {
  constexpr double kFinest = 0.35;  // smallest width of leaves where d is steep [d]
  // Upper bound of the distance from a sample to the centre of the adjacent cell [sides]
  constexpr double kBeside = 1.6;
  const double side = points_.side_of(leaf.cell);
  if (leaf.cell.depth == BackgroundTree<Dim>::kMaxDepth) return false;
  if (side > method::kLeafSpacings * leaf.min) return true;
  if (steepest == 0 || side <= kFinest * leaf.min) return false;
  return leaf.max - leaf.min > steepest * side ||
         leaf.max_beside - leaf.min > kBeside * steepest * side;
}

// Splits the open leaves that are too wide and closes the others. Returns whether this rank split
// any.
template <int Dim>
bool GrowthLeaves<Dim>::split_open(double steepest) {
  const auto splits = [&](const GrowthLeaf<Dim>& leaf) {
    return leaf.open && too_wide(leaf, steepest);
  };
  const bool any = std::any_of(leaves_.begin(), leaves_.end(), splits);
  if (!any) {
    for (GrowthLeaf<Dim>& leaf : leaves_) leaf.open = false;
    return false;
  }
  std::vector<GrowthLeaf<Dim>> next;
  for (GrowthLeaf<Dim>& leaf : leaves_) {
    if (splits(leaf)) {
      split(leaf, next);
    } else {
      leaf.open = false;
      next.push_back(leaf);
    }
  }
  leaves_ = std::move(next);
  return true;
}

// The child that contains the source keeps it.
template <int Dim>
void GrowthLeaves<Dim>::split(const GrowthLeaf<Dim>& leaf,
                              std::vector<GrowthLeaf<Dim>>& next) const {
  const FineIndex<Dim> fine_of_source = points_.fine_index(leaf.source.x);
  for (int k = 0; k < BackgroundTree<Dim>::kChildren; ++k) {
    GrowthLeaf<Dim> child = leaf;
    child.cell = leaf.cell.child(k);
    child.fresh = true;
    child.probed = false;
    if (!child.cell.holds(fine_of_source)) child.source = {};
    look_at_domain(child);
    next.push_back(child);
  }
}

// Stops early: this lower bound, from the largest d of each leaf, already exceeds the allowed
// number of nodes.
template <int Dim>
void GrowthLeaves<Dim>::require_small_node_set() const {
  constexpr double kMaxThatAddUp = 9e18;  // sums over all ranks must fit into 64 bits
  double own = 0;
  for (const GrowthLeaf<Dim>& leaf : leaves_)
    if (leaf.side == GrowthLeaf<Dim>::Side::inside)
      own += Lattice<Dim>::kDensity * power<Dim>(points_.side_of(leaf.cell) / leaf.max);
  const auto nodes = static_cast<double>(comm_.allreduce_sum(
      static_cast<std::uint64_t>(std::round(std::min(own, kMaxThatAddUp / comm_.size())))));
  if (nodes > static_cast<double>(limit_.max_nodes)) report_too_many(nodes);
  limit_.require_memory_for(nodes);
}

// Throws an error that names the finest leaf of all ranks. Collective.
template <int Dim>
void GrowthLeaves<Dim>::report_too_many(double nodes) const {
  struct Finest {
    double d;
    Point<Dim> x;
  };
  const auto before = [](const Finest& a, const Finest& b) {
    return std::tie(a.d, a.x) < std::tie(b.d, b.x);
  };
  Finest finest{std::numeric_limits<double>::infinity(), {}};
  for (const GrowthLeaf<Dim>& leaf : leaves_)
    if (!leaf.outside())
      finest =
          std::min(finest, Finest{leaf.min, middle_of<Dim>(points_.box_of(leaf.cell))}, before);
  Bytes mine;
  pack(mine, finest);
  for_records<Finest>(comm_.allgather(mine),
                      [&](const Finest& found) { finest = std::min(finest, found, before); });
  limit_.report_too_many(nodes, finest.d, point_text(finest.x));
}

template class GrowthLeaves<2>;
template class GrowthLeaves<3>;

}  // namespace pnpbs
