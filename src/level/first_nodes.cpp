// SPDX-License-Identifier: BSD-3-Clause
#include "level/first_nodes.hpp"

#include <optional>

#include "comm/records.hpp"
#include "initial/graded_fill.hpp"
#include "initial/initial_fill.hpp"
#include "level/numbering.hpp"
#include "level/plane/closed_sphere.hpp"

namespace pnpbs {

namespace {

// Returns summaries of d for the leaves that this rank has not refined. The owners of the cells
// send them. Collective.
template <int Dim>
std::vector<LeafSummary<Dim>> summaries_of_unrefined_leaves(const Level<Dim>& level) {
  if (!level.distributed()) return {};
  const Distribution<Dim>& distribution = level.tree->distribution();
  const PartitionCells<Dim>& cells = distribution.cells();
  const BackgroundTree<Dim>& tree = level.tree->tree();
  const std::vector<SpacingSummary<Dim>> own = spacing_summaries(level.map(), {});
  struct CellSummary {
    std::int32_t cell;
    SpacingSummary<Dim> spacing;
  };
  Bytes mine;
  for (std::int32_t c = 0; c < cells.count(); ++c) {
    if (distribution.owner_of_cell(c) != level.comm->rank()) continue;
    const std::int32_t cell = cells.tree().leaf_cell(c);
    const std::int32_t here =
        tree.cell_at(cells.tree().cell_centre(cell), cells.tree().cell(cell).depth);
    pack(mine, CellSummary{c, own[static_cast<std::size_t>(here)]});
  }
  std::vector<SpacingSummary<Dim>> summaries(static_cast<std::size_t>(cells.count()));
  for_records<CellSummary>(level.comm->allgather(mine), [&](const CellSummary& summary) {
    summaries[static_cast<std::size_t>(summary.cell)] = summary.spacing;
  });
  std::vector<LeafSummary<Dim>> unrefined;
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf)
    if (!distribution.refined(leaf) && tree.in_periodic_cell(leaf))
      unrefined.push_back({leaf, summaries[static_cast<std::size_t>(distribution.cell_of(leaf))]});
  return unrefined;
}

// Returns the nodes of the owned leaves in which d grows too fast for a lattice. All ranks must
// call it, and if one rank throws, all ranks throw.
template <int Dim>
std::vector<Point<Dim>> graded_fill(const Level<Dim>& level,
                                    const std::function<bool(std::int32_t)>& owned) {
  std::optional<GradedFill<Dim>> fill;
  std::vector<double> d;
  collective_try(*level.comm, [&] {
    fill.emplace(level.map(), owned);
    d.resize(fill->centres().size());
    level.geometry.evaluator()(static_cast<std::int64_t>(d.size()), fill->centres().data(),
                               d.data());
  });
  std::int64_t end = 0;
  const std::vector<std::int64_t> before =
      level.tree->distribution().prefix_sums(*level.comm, fill->wanted_nodes(d), end);
  std::vector<Point<Dim>> nodes;
  collective_try(*level.comm, [&] { nodes = fill->place(d, before); });
  return nodes;
}

}  // namespace

template <int Dim>
IncomingNodes<Dim> first_inner_nodes(const Level<Dim>& level, const std::function<void()>& beat,
                                     bool stretched) {
  IncomingNodes<Dim> inner;
  const std::vector<LeafSummary<Dim>> unrefined = summaries_of_unrefined_leaves(level);
  const auto owned = [&](std::int32_t leaf) {
    beat();
    return level.tree->owns(leaf);
  };
  collective_try(*level.comm, [&] {
    for (const Point<Dim>& x :
         lattice_fill<Dim>(level.map(), level.geometry.bounds(), owned, unrefined, stretched))
      inner.push_back({x, -1});
  });
  for (const Point<Dim>& x : graded_fill(level, owned)) inner.push_back({x, -1});
  std::erase_if(inner,
                [&](const IncomingNode<Dim>& node) { return is_closed_at(level, node.position); });
  return inner;
}

template <int Dim>
void fill(Level<Dim>& level, BoundaryNodes<Dim> laid, const std::function<void()>& beat,
          bool stretched) {
  const PhaseTimer timer(level.timers, Phase::fill);
  IncomingNodes<Dim> inner = first_inner_nodes(level, beat, stretched);
  collective_try(*level.comm, [&] {
    beat();
    find_leaves(level, inner);
    beat();
    sort_by_leaf(level, inner);
  });
  number_and_store(level, std::move(inner), std::move(laid));
}

template void fill(Level<2>&, BoundaryNodes<2>, const std::function<void()>&, bool);
template void fill(Level<3>&, BoundaryNodes<3>, const std::function<void()>&, bool);

template IncomingNodes<2> first_inner_nodes(const Level<2>&, const std::function<void()>&, bool);
template IncomingNodes<3> first_inner_nodes(const Level<3>&, const std::function<void()>&, bool);

}  // namespace pnpbs
