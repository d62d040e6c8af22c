// SPDX-License-Identifier: BSD-3-Clause
#include "level/rebalance.hpp"

#include "level/exchange.hpp"
#include "level/lists_and_stars.hpp"
#include "level/reach.hpp"

namespace pnpbs {

namespace {

std::vector<std::int64_t> counted_work(const Level& level) {
  const BackgroundTree<2>& tree = level.tree->tree();
  const Nodes<2>& nodes = level.nodes;
  std::vector<std::int64_t> work(static_cast<std::size_t>(tree.leaf_count()), 0);
  for (std::int64_t i = 0; i < nodes.count; ++i)
    if (nodes.owned(i))
      work[static_cast<std::size_t>(tree.leaf_at(nodes.position(i)))] +=
          level.neighbourhood.work_of(i);
  return work;
}

void migrate(Level& level) {
  const PhaseTimer timer(level.timers, Phase::exchange);
  level.ghosts.migrate(*level.comm, *level.tree, level.nodes, level.neighbourhood);
}

}  // namespace

double imbalance_of(const Level& level) {
  const std::int64_t own = level.neighbourhood.owned_work();
  const auto all = static_cast<double>(level.comm->allreduce_sum(static_cast<std::uint64_t>(own)));
  return all > 0 ? level.comm->allreduce_max(static_cast<double>(own)) * level.comm->size() / all
                 : 1;
}

void rebalance(Level& level) {
  if (!level.distributed()) return;
  const int hops = step_hops(level.settings);
  exchange(level, hops);
  agreed(*level.comm, [&] { rebuild_lists_for_steps(level); });
  const PhaseTimer timer(level.timers, Phase::partition);
  level.adopt_partition(level.tree->redistributed(level.settings, counted_work(level)));
  migrate(level);
  exchange(level, hops);
  level.neighbourhood.recount_work();
  agreed(*level.comm, [&] { rebuild_lists_for_steps(level); });
  ++level.rebalances;
}

}  // namespace pnpbs
