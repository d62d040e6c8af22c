// SPDX-License-Identifier: BSD-3-Clause
#include "level/rebalance.hpp"

#include "level/exchange.hpp"
#include "level/lists_and_stars.hpp"
#include "level/partitioning.hpp"
#include "level/reach.hpp"
#include "partition/partition.hpp"

namespace pnpbs {

namespace {

// Rare work that one rank must have more than the mean of all, per node of a rank, for a
// repartition to pay.
constexpr double kLeastExcess = 0.005;
// Share of the imbalance of rare work that may remain after a repartition.
constexpr double kMuchLess = 0.5;

// Sums the work of the owned nodes by leaf.
template <int Dim, class WorkOf>
std::vector<std::int64_t> work_of_leaves(const Level<Dim>& level, const WorkOf& work_of) {
  const BackgroundTree<Dim>& tree = level.tree->tree();
  const Nodes<Dim>& nodes = level.nodes;
  std::vector<std::int64_t> work(static_cast<std::size_t>(tree.leaf_count()), 0);
  for (std::int64_t i = 0; i < nodes.count; ++i)
    if (nodes.owned(i))
      work[static_cast<std::size_t>(tree.leaf_at(nodes.position(i)))] += work_of(i);
  return work;
}

template <int Dim>
std::vector<std::int64_t> counted_work(const Level<Dim>& level) {
  return work_of_leaves(level, [&](std::int64_t i) { return level.neighbourhood.work_of(i); });
}

// Returns the largest over the mean of a value of all ranks. Collective.
double imbalance_over(const Communicator& comm, std::int64_t own) {
  const auto all = static_cast<double>(comm.allreduce_sum(static_cast<std::uint64_t>(own)));
  return all > 0 ? comm.allreduce_max(static_cast<double>(own)) * comm.size() / all : 1;
}

template <int Dim>
void migrate(Level<Dim>& level) {
  const PhaseTimer timer(level.timers, Phase::exchange);
  level.ghosts.migrate(*level.comm, *level.tree, level.nodes, level.neighbourhood);
}

}  // namespace

template <int Dim>
double imbalance_of(const Level<Dim>& level) {
  return imbalance_over(*level.comm, level.neighbourhood.owned_work());
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

// The lists and stars are not made again here, since those of the phase reach farther.
template <int Dim>
void rebalance_for(Level<Dim>& level, const View<std::int64_t>& rare_work) {
  if (!level.distributed()) return;
  const PhaseTimer timer(level.timers, Phase::partition);
  const Nodes<Dim>& nodes = level.nodes;
  const std::int64_t own =
      static_cast<std::int64_t>(sum_of("pnpbs::rebalance_for", nodes.count, [&](std::int64_t i) {
        return nodes.owned(i) ? static_cast<std::uint64_t>(rare_work(i)) : 0;
      }));
  const double present = imbalance_over(*level.comm, own);
  const double largest = level.comm->allreduce_max(static_cast<double>(own));
  const std::uint64_t all_nodes =
      level.comm->allreduce_sum(static_cast<std::uint64_t>(level.owned_count()));
  const double excess = largest * (1 - 1 / present),
               mean_nodes = static_cast<double>(all_nodes) / level.comm->size();
  if (present <= level.settings.rebalance_above || excess < kLeastExcess * mean_nodes) return;
  Distribution<Dim> next =
      redistributed(*level.tree, level.settings, counted_work(level),
                    work_of_leaves(level, [&](std::int64_t i) { return rare_work(i); }));
  // METIS may fail or not balance few heavy cells. All ranks have the same cells and owners.
  const PartitionCells<Dim>& cells = next.cells();
  const auto imbalance_after = [&](const std::vector<std::int64_t>& work) {
    return next.imbalance_of(work);
  };
  if (imbalance_after(cells.rare_work()) - 1 > kMuchLess * (present - 1) ||
      imbalance_after(cells.work()) > level.settings.rebalance_above)
    return;
  take_stars(level);
  level.adopt_partition(std::move(next));
  migrate(level);
  ++level.rebalances;
}

template double imbalance_of(const Level<2>&);
template double imbalance_of(const Level<3>&);
template void rebalance(Level<2>&);
template void rebalance(Level<3>&);
template void rebalance_for(Level<2>&, const View<std::int64_t>&);
template void rebalance_for(Level<3>&, const View<std::int64_t>&);

}  // namespace pnpbs
