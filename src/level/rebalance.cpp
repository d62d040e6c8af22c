// SPDX-License-Identifier: BSD-3-Clause
#include "level/rebalance.hpp"

#include "level/exchange.hpp"
#include "level/lists_and_stars.hpp"
#include "level/partitioning.hpp"
#include "level/reach.hpp"

namespace pnpbs {

namespace {

template <int Dim>
std::vector<std::int64_t> counted_work(const Level<Dim>& level) {
  const BackgroundTree<Dim>& tree = level.tree->tree();
  const Nodes<Dim>& nodes = level.nodes;
  std::vector<std::int64_t> work(static_cast<std::size_t>(tree.leaf_count()), 0);
  for (std::int64_t i = 0; i < nodes.count; ++i)
    if (nodes.owned(i))
      work[static_cast<std::size_t>(tree.leaf_at(nodes.position(i)))] +=
          level.neighbourhood.work_of(i);
  return work;
}

template <int Dim>
void migrate(Level<Dim>& level) {
  const PhaseTimer timer(level.timers, Phase::exchange);
  level.ghosts.migrate(*level.comm, *level.tree, level.nodes, level.neighbourhood);
}

}  // namespace

template <int Dim>
double imbalance_of(const Level<Dim>& level) {
  const std::int64_t own = level.neighbourhood.owned_work();
  const auto all = static_cast<double>(level.comm->allreduce_sum(static_cast<std::uint64_t>(own)));
  return all > 0 ? level.comm->allreduce_max(static_cast<double>(own)) * level.comm->size() / all
                 : 1;
}

template <int Dim>
void rebalance(Level<Dim>& level) {
  if (!level.distributed()) return;
  const int hops = step_hops(level.settings);
  exchange(level, hops);
  collective_try(*level.comm,
                 [&] { rebuild_lists_for_steps(level, lists_of_steps(level.settings)); });
  const PhaseTimer timer(level.timers, Phase::partition);
  level.adopt_partition(redistributed(*level.tree, level.settings, counted_work(level)));
  migrate(level);
  exchange(level, hops);
  level.neighbourhood.recount_work();
  collective_try(*level.comm,
                 [&] { rebuild_lists_for_steps(level, lists_of_steps(level.settings)); });
  ++level.rebalances;
}

template double imbalance_of(const Level<2>&);
template double imbalance_of(const Level<3>&);
template void rebalance(Level<2>&);
template void rebalance(Level<3>&);

}  // namespace pnpbs
