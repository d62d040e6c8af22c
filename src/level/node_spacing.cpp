// SPDX-License-Identifier: BSD-3-Clause
#include "level/node_spacing.hpp"

#include <algorithm>

namespace pnpbs {

// The spacing is evaluated equally often on all ranks: it may live distributed over them.
View<double> spacing_at_owned_nodes(const Level& level, const Spacing<2>& spacing) {
  const Nodes<2>& nodes = level.nodes;
  constexpr std::int64_t kBatch = 1 << 14;  // bounds the memory for the points handed out
  const std::int64_t last =
      static_cast<std::int64_t>(level.comm->allreduce_max(static_cast<double>(nodes.count)));
  View<double> all;
  agreed(*level.comm, [&] {
    all = make_view<double>("pnpbs::spacings", nodes.count);
    std::vector<std::int32_t> owned;
    std::vector<Point<2>> x;
    std::vector<double> d;
    const auto max = static_cast<std::size_t>(std::min(kBatch, nodes.count));
    owned.reserve(max);
    x.reserve(max);
    d.reserve(max);
    for (std::int64_t first = 0; first < last; first += kBatch) {
      owned.clear();
      for (std::int64_t i = first; i < std::min(first + kBatch, nodes.count); ++i)
        if (nodes.owned(i)) owned.push_back(static_cast<std::int32_t>(i));
      x.resize(owned.size());
      d.resize(owned.size());
      const auto n = static_cast<std::int64_t>(owned.size());
      for_each("pnpbs::points_for_spacing", n, [&](std::int64_t k) {
        const auto at = static_cast<std::size_t>(k);
        x[at] = nodes.position(owned[at]);
      });
      evaluate_spacing<2>(spacing, level.ground.domain().area(), n, x.data(), d.data());
      for_each("pnpbs::take_spacing", n, [&](std::int64_t k) {
        const auto at = static_cast<std::size_t>(k);
        all(owned[at]) = d[at];
      });
    }
  });
  return all;
}

// If the callback fails, all stays as it is.
void refresh_spacing(Level& level) {
  const PhaseTimer timer(level.timers, Phase::spacing);
  Nodes<2>& nodes = level.nodes;
  const View<double> d = spacing_at_owned_nodes(level, level.ground.spacing());
  for_each("pnpbs::refresh_spacing", nodes.count, [&](std::int64_t i) {
    if (!nodes.owned(i)) return;
    nodes.d(i) = d(i);
    if (nodes.moves(i)) return;
    nodes.d(i) = std::min(d(i), level.ground.bubble_bound(nodes.boundary_node(i)));
  });
  nodes.set_reference_positions();
  level.ghosts.choose_anew();
}

}  // namespace pnpbs
