// SPDX-License-Identifier: BSD-3-Clause
// The distance around a node within which its adjacency list contains all nodes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/nodes.hpp"
#include "neighbors/adjacency_list.hpp"
#include "neighbors/buckets.hpp"
#include "partition/known_region.hpp"

namespace pnpbs {

// A calculator of this distance for one node after the other. It is fast for nodes that are
// consecutive in memory, because it caches data of the last bucket.
template <int Dim>
class ListedReach {
 public:
  ListedReach(const Nodes<Dim>& nodes, const BackgroundTree<Dim>& tree, const Buckets<Dim>& buckets,
              const AdjacencyList<Dim>& lists, const KnownRegion<Dim>& known)
      : nodes_(nodes), tree_(tree), buckets_(buckets), lists_(lists), known_(known) {}

  // Returns the distance within which the list of node i contains all nodes visible from it.
  // Returns 0 if this rank does not know all nodes there.
  double of(std::int64_t i) {
    const double reach = whatever_is_known(i);
    const bool known = !border_ || known_.covers(tree_, box_around<Dim>(nodes_.position(i), reach));
    return known ? reach : 0;
  }

  // Returns of(i) under the assumption that all nodes are known.
  double whatever_is_known(std::int64_t i) {
    if (buckets_.bucket_of(i) != bucket_) look_at_bucket(buckets_.bucket_of(i));
    constexpr double kSteep = 0.9;
    const double d = nodes_.d(i);
    return min_ < kSteep * d ? reach_to_unlisted(i) : 0.5 * lists_.radius() * (nodes_.d(i) + min_);
  }

 private:
  void look_at_bucket(std::int32_t bucket) {
    bucket_ = bucket;
    min_ = std::numeric_limits<double>::infinity();
    buckets_.for_neighbours(
        bucket, [&](std::int32_t b) { min_ = std::min(min_, buckets_.min_spacing(b)); });
    double max = 0;
    for (std::int32_t i = buckets_.begin(bucket); i < buckets_.end(bucket); ++i)
      max = std::max(max, nodes_.d(i));
    const Box<Dim> cell = tree_.cell_box(tree_.leaf_cell(bucket));
    border_ = !known_.covers(tree_, widened(cell, lists_.radius() * max));
  }

  // Returns the distance to the nearest node that the list does not contain, limited to what stars
  // usually require. The neighbour buckets contain all nodes within radius * d.
  double reach_to_unlisted(std::int64_t i) const {
    constexpr double kNeeded = 1.5, kRounding = 1 - 1e-9;
    const Point<Dim> at = nodes_.position(i);
    const double own = nodes_.d(i), radius = lists_.radius();
    const double needed = std::min(kNeeded, radius) * own, half = 0.5 * kRounding * radius;
    const Box<Dim> box = box_around<Dim>(at, needed);
    std::array<const double*, Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = nodes_.x[k].data();
    const double* const d = nodes_.d.data();
    double nearest = needed * needed;
    buckets_.for_neighbours(bucket_, [&](std::int32_t b) {
      const Box<Dim> cell = tree_.cell_box_with_room(tree_.leaf_cell(b));
      for (int k = 0; k < Dim; ++k)
        if (cell.high[k] < box.low[k] || cell.low[k] > box.high[k]) return;
#pragma omp simd reduction(min : nearest)
      for (std::int32_t j = buckets_.begin(b); j < buckets_.end(b); ++j) {
        double square = 0;
        for (int k = 0; k < Dim; ++k) square += (x[k][j] - at[k]) * (x[k][j] - at[k]);
        const double listed = half * (own + d[j]);
        const double unlisted = square < listed * listed ? nearest : square;
        nearest = unlisted < nearest ? unlisted : nearest;
      }
    });
    return kRounding * std::sqrt(nearest);
  }

  const Nodes<Dim>& nodes_;
  const BackgroundTree<Dim>& tree_;
  const Buckets<Dim>& buckets_;
  const AdjacencyList<Dim>& lists_;
  const KnownRegion<Dim>& known_;
  std::int32_t bucket_ = -1;
  double min_ = 0;       // Smallest spacing in the bucket and its neighbours.
  bool border_ = false;  // Whether lists of the bucket extend into unknown regions.
};

}  // namespace pnpbs
