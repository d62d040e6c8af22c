// SPDX-License-Identifier: BSD-3-Clause
#include "level/exchange.hpp"

#include "comm/records.hpp"
#include "level/reach.hpp"

namespace pnpbs {

namespace {

template <int Dim>
void update_without_agreement(Level<Dim>& level) {
  count_inexact_nodes(level);
  const PhaseTimer timer(level.timers, Phase::exchange);
  level.ghosts.update(*level.tree, level.nodes);
}

}  // namespace

template <int Dim>
void exchange(Level<Dim>& level, int hops) {
  if (!level.distributed()) return;
  count_inexact_nodes(level);
  // The tree must be refined deeper than for earlier exchanges.
  if (hops + 2 > level.tree->hops())
    level.adopt_partition(level.tree->distribution().without_leaves());
  const PhaseTimer timer(level.timers, Phase::exchange);
  level.ghosts.exchange(*level.comm, *level.tree, level.settings, hops, level.nodes,
                        level.neighbourhood);
}

template <int Dim>
void exchange_for_steps(Level<Dim>& level, std::exception_ptr& failure) {
  if (!level.distributed()) return;
  const int hops = step_hops(level.settings);
  if (!level.ghosts.can_stay(level.settings, hops)) {
    agree_on_failure(*level.comm, failure);
    exchange(level, hops);
  } else {
    if (!level.ghosts.prepared()) {
      agree_on_failure(*level.comm, failure);
      level.ghosts.prepare_updates(*level.comm);
    }
    run_and_keep(failure, [&] { update_without_agreement(level); });
    attempt(failure, [&] { level.neighbourhood.measure_displacement(level.nodes); });
  }
}

template <int Dim>
void update_ghosts(Level<Dim>& level) {
  if (!level.distributed()) return;
  level.ghosts.prepare_updates(*level.comm);
  update_without_agreement(level);
}

template <int Dim>
void scatter_to_owners(const Level<Dim>& level, IncomingNodes<Dim>& incoming) {
  if (!level.distributed()) return;
  for (IncomingNode<Dim>& node : incoming) put_in_cell(level, node);
  const auto owner_of = [&](const IncomingNode<Dim>& node) {
    return level.tree->owner_at(node.position);
  };
  const View<std::int32_t> owner =
      make_view<std::int32_t>("pnpbs::owner", static_cast<std::int64_t>(incoming.size()));
  for_each("pnpbs::find_owners", static_cast<std::int64_t>(incoming.size()),
           [&](std::int64_t k) { owner(k) = owner_of(incoming[static_cast<std::size_t>(k)]); });
  std::vector<IncomingNode<Dim>> leaving;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < incoming.size(); ++k) {
    if (owner(k) == level.comm->rank())
      incoming[kept++] = incoming[k];
    else
      leaving.push_back(incoming[k]);
  }
  incoming.resize(kept);
  const std::vector<IncomingNode<Dim>> arrived =
      redistribute<IncomingNode<Dim>>(*level.comm, leaving, owner_of);
  incoming.insert(incoming.end(), arrived.begin(), arrived.end());
}

template void exchange(Level<2>&, int);
template void exchange(Level<3>&, int);
template void exchange_for_steps(Level<2>&, std::exception_ptr&);
template void exchange_for_steps(Level<3>&, std::exception_ptr&);
template void update_ghosts(Level<2>&);
template void update_ghosts(Level<3>&);
template void scatter_to_owners(const Level<2>&, IncomingNodes<2>&);
template void scatter_to_owners(const Level<3>&, IncomingNodes<3>&);

}  // namespace pnpbs
