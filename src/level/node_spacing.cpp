// SPDX-License-Identifier: BSD-3-Clause
#include "level/node_spacing.hpp"

#include <algorithm>

namespace pnpbs {

namespace {

// The spacing may be distributed over the ranks, so all ranks evaluate it equally often.
template <int Dim>
View<double> spacing_at(const Level<Dim>& level, const Spacing<Dim>& spacing, bool ghosts) {
  const Nodes<Dim>& nodes = level.nodes;
  constexpr std::int64_t kBatch = 1 << 14;  // limits the memory for the points
  const std::int64_t last =
      static_cast<std::int64_t>(level.comm->allreduce_max(static_cast<double>(nodes.count)));
  View<double> all;
  collective_try(*level.comm, [&] {
    all = make_view<double>("pnpbs::spacings", nodes.count);
    std::vector<std::int32_t> wanted;
    std::vector<Point<Dim>> x;
    std::vector<double> d;
    const auto max = static_cast<std::size_t>(std::min(kBatch, nodes.count));
    wanted.reserve(max);
    x.reserve(max);
    d.reserve(max);
    for (std::int64_t first = 0; first < last; first += kBatch) {
      wanted.clear();
      for (std::int64_t i = first; i < std::min(first + kBatch, nodes.count); ++i)
        if (ghosts || nodes.owned(i)) wanted.push_back(static_cast<std::int32_t>(i));
      x.resize(wanted.size());
      d.resize(wanted.size());
      const auto n = static_cast<std::int64_t>(wanted.size());
      for_each("pnpbs::points_for_spacing", n, [&](std::int64_t k) {
        const auto at = static_cast<std::size_t>(k);
        x[at] = nodes.position(wanted[at]);
      });
      evaluate_spacing<Dim>(spacing, level.geometry.measure(), n, x.data(), d.data());
      for_each("pnpbs::take_spacing", n, [&](std::int64_t k) {
        const auto at = static_cast<std::size_t>(k);
        all(wanted[at]) = d[at];
      });
    }
  });
  return all;
}

}  // namespace

template <int Dim>
View<double> spacing_at_nodes(const Level<Dim>& level, const Spacing<Dim>& spacing) {
  return spacing_at(level, spacing, true);
}

template <int Dim>
View<double> spacing_at_owned_nodes(const Level<Dim>& level, const Spacing<Dim>& spacing) {
  return spacing_at(level, spacing, false);
}

// A failure of the callback leaves the nodes unchanged.
template <int Dim>
void refresh_spacing(Level<Dim>& level) {
  const PhaseTimer timer(level.timers, Phase::spacing);
  Nodes<Dim>& nodes = level.nodes;
  const View<double> d = spacing_at_owned_nodes(level, level.geometry.spacing());
  for_each("pnpbs::refresh_spacing", nodes.count, [&](std::int64_t i) {
    if (!nodes.owned(i)) return;
    nodes.d(i) = level.geometry.bubble_at(nodes, i, d(i));
  });
  nodes.set_reference_positions();
  level.ghosts.invalidate();
}

template View<double> spacing_at_nodes(const Level<2>&, const Spacing<2>&);
template View<double> spacing_at_nodes(const Level<3>&, const Spacing<3>&);
template View<double> spacing_at_owned_nodes(const Level<2>&, const Spacing<2>&);
template View<double> spacing_at_owned_nodes(const Level<3>&, const Spacing<3>&);
template void refresh_spacing(Level<2>&);
template void refresh_spacing(Level<3>&);

}  // namespace pnpbs
