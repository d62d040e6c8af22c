// SPDX-License-Identifier: BSD-3-Clause
// What the stars of a finished run in space tell, the same from which results are handed out.
#include <string>

#include "placement/placement_of.hpp"

namespace pnpbs {

namespace {

// Of surfaces alone: owned nodes that no triangle has, or, between features, not all around.
std::uint64_t nodes_without_star(const Level<3>& level) {
  const Nodes<3>& nodes = level.nodes;
  if (!level.ground.surfaces_alone()) return 0;
  return sum_of("pnpbs::nodes_without_star", nodes.count, [&](std::int64_t i) -> std::uint64_t {
    if (!nodes.owned(i)) return 0;
    return level.stars.size(i) == 0 || (nodes.moves(i) && !level.stars.closed(i));
  });
}

}  // namespace

// Collective.
template <>
void PlacementOf<3>::measure_finish() {
  prepare_stars();
  agreed(*comm_,
         [this] { edge_bands_ = measure_edge_bands<3>(*comm_, level_->nodes, level_->stars); });
  unknown_uses_ = static_cast<std::int64_t>(
      comm_->allreduce_sum(static_cast<std::uint64_t>(level_->unknown_uses)));
  if (unknown_uses_ > 0)
    warnings_.push_back(
        "the nodes may depend on the number of ranks: " + std::to_string(unknown_uses_) +
        " decisions looked beyond what a rank knows (statistic unknown_uses); on "
        "one rank they do not");
  surface_fit_ = measure_surface_fit(*level_);
  const std::uint64_t without = comm_->allreduce_sum(nodes_without_star(*level_));
  if (without > 0)
    warnings_.push_back("triangles are missing around " + std::to_string(without) +
                        " nodes, where the surface is rougher than the spacing resolves: use a "
                        "smaller spacing there, or a larger feature_angle");
}

}  // namespace pnpbs
