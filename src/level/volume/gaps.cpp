// SPDX-License-Identifier: BSD-3-Clause
#include "level/volume/gaps.hpp"

#include "base/found_indices.hpp"
#include "level/exchange.hpp"
#include "level/first_nodes.hpp"
#include "level/lists_and_stars.hpp"
#include "level/reach.hpp"
#include "level/volume/added_nodes.hpp"
#include "method/constants.hpp"

namespace pnpbs {

namespace {

// Returns whether node i is closer to the candidate than `gap` times its d. Surface nodes count
// only if they are on the same side of the surface.
bool covers(const Level<3>& level, std::int64_t i, const IncomingNode<3>& candidate, double gap) {
  const Nodes<3>& nodes = level.nodes;
  if (distance<3>(nodes.position(i), candidate.position) >= gap * nodes.d(i)) return false;
  if (candidate.is_inner() || nodes.carrier(i) == Carrier::free) return candidate.is_inner();
  const LevelGeometry<3>& geometry = level.geometry;
  return geometry.surface().sees(geometry.place(nodes, i),
                                 geometry.place(candidate.carrier, candidate.boundary_node));
}

}  // namespace

bool is_covered(const Level<3>& level, const IncomingNode<3>& candidate, double gap) {
  const std::int32_t leaf = level.tree->tree().leaf_at(candidate.position);
  const Buckets<3>& buckets = level.neighbourhood.buckets();
  bool covered = false;
  buckets.for_neighbours(leaf, [&](std::int32_t b) {
    for (std::int64_t i = buckets.begin(b); !covered && i < buckets.end(b); ++i)
      covered = covers(level, i, candidate, gap);
  });
  return covered;
}

IncomingNodes<3> in_gaps(Level<3>& level, const IncomingNodes<3>& candidates, double gap) {
  const PhaseTimer timer(level.timers, Phase::fill);
  exchange(level, kStarHops);
  IncomingNodes<3> found;
  collective_try(*level.comm, [&] {
    sort_nodes(level);
    const auto is_in_gap = [&](std::int64_t k) {
      const IncomingNode<3>& candidate = candidates[static_cast<std::size_t>(k)];
      const std::int32_t leaf = level.tree->tree().leaf_at(candidate.position);
      return level.tree->owns(leaf) && !is_covered(level, candidate, gap);
    };
    for (const std::int64_t k : indices_where("pnpbs::in_gaps", std::ssize(candidates), is_in_gap))
      found.push_back(candidates[static_cast<std::size_t>(k)]);
  });
  return found;
}

std::int64_t fill_gaps_inside(Level<3>& level) {
  return add_nodes(level, in_gaps(level, first_inner_nodes(level)));
}

}  // namespace pnpbs
