// SPDX-License-Identifier: BSD-3-Clause
#include "quality/sweep.hpp"

#include <algorithm>

#include "dynamics/bubble_force.hpp"
#include "dynamics/schemes.hpp"
#include "quality/sweep_guard.hpp"

namespace pnpbs {

namespace {

// Proposes positions for the nodes of block b. Nodes that do not move, and nodes without a closed
// star of at least three neighbours, keep their positions.
void propose(const Nodes<2>& nodes, const DelaunayStars& stars, const NearEdges& near_edges,
             const SizedTree<2>& map, const SweepRule& rule, Field<2>& proposed, std::int64_t b) {
  const DelaunayStars::Block block = stars.block(b);
  const Positions<2> x = positions_of<2>(nodes.x);
  std::array<double, kLanes> sum_x{}, sum_y{}, from_x{}, from_y{};
  const std::int64_t first = b * kLanes;
  const int lanes = static_cast<int>(std::min<std::int64_t>(kLanes, nodes.count - first));
  // In a periodic domain sums are relative to the node, so that they are the same for its images.
  for (int lane = 0; nodes.cell.any() && lane < lanes; ++lane) {
    from_x[lane] = x[0][first + lane];
    from_y[lane] = x[1][first + lane];
  }
  const DelaunayStars::Entry* entries = block.entries;
  for (std::int32_t k = 0; k < block.length; ++k, entries += kLanes) {
#pragma omp simd
    for (int lane = 0; lane < kLanes; ++lane) {
      const std::int32_t j = entries[lane].value();
      const double there = k < block.sizes[lane].value() ? 1.0 : 0.0;
      sum_x[lane] += there * (x[0][j] - from_x[lane]);
      sum_y[lane] += there * (x[1][j] - from_y[lane]);
    }
  }
  for (int lane = 0; lane < lanes; ++lane) {
    const std::int64_t i = first + lane;
    const std::int32_t n = block.sizes[lane].value();
    const bool may = nodes.moves(i) && n >= 3 && block.sizes[lane].flag();
    const Point<2> move{rule.weight * (sum_x[lane] / n - (x[0][i] - from_x[lane])),
                        rule.weight * (sum_y[lane] / n - (x[1][i] - from_y[lane]))};
    if (may)
      propose_move(nodes, near_edges, map, rule, i, move, proposed);
    else
      propose_current_position(nodes, i, proposed);
  }
}

}  // namespace

void propose_move(const Nodes<2>& nodes, const NearEdges& near_edges, const SizedTree<2>& map,
                  const SweepRule& rule, std::int64_t i, Point<2> move, Field<2>& proposed) {
  const Point<2> x = nodes.position(i);
  clamp_move<2>(move, rule.max_move * nodes.d(i));
  const Point<2> to = nodes.position_after(i, move);
  for (int k = 0; k < 2; ++k) proposed[k](i) = to[k];
  if (!near_edges.any(i)) return;
  const ClearPosition<2> kept =
      clear_position(map, near_edges.edges_of(i), x, point_at<2>(proposed, i), nodes.d(i));
  const Point<2> clear = nodes.cell.rounded(kept.position);
  for (int k = 0; k < 2; ++k) proposed[k](i) = kept.clear ? clear[k] : x[k];
}

void propose_current_position(const Nodes<2>& nodes, std::int64_t i, Field<2>& proposed) {
  for (int k = 0; k < 2; ++k) proposed[k](i) = nodes.x[k](i);
}

void apply_allowed_moves(Nodes<2>& nodes, const DelaunayStars& stars, const SweepRule& rule,
                         const Field<2>& proposed, View<char>& allowed) {
  const QualityBound bound(rule.bad_below);
  for_each("pnpbs::sweep::guard", stars.block_count(), [&](std::int64_t b) {
    guard_block(nodes, stars, rule.bad_below, bound, proposed, allowed, b);
  });
  for_each("pnpbs::sweep::go", nodes.count, [&](std::int64_t i) {
    if (allowed(i)) nodes.set_position(i, point_at<2>(proposed, i));
  });
  nodes.moved();
}

void sweep(Nodes<2>& nodes, const DelaunayStars& stars, const NearEdges& near_edges,
           const SizedTree<2>& map, const SweepRule& rule, Field<2>& proposed,
           View<char>& allowed) {
  for_each("pnpbs::sweep::propose", stars.block_count(),
           [&](std::int64_t b) { propose(nodes, stars, near_edges, map, rule, proposed, b); });
  apply_allowed_moves(nodes, stars, rule, proposed, allowed);
}

}  // namespace pnpbs
