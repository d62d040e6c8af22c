// SPDX-License-Identifier: BSD-3-Clause
#include "level/first_nodes.hpp"

#include <optional>

#include "comm/records.hpp"
#include "initial/graded_fill.hpp"
#include "initial/initial_fill.hpp"
#include "level/numbering.hpp"

namespace pnpbs {

namespace {

// Where the tree is not refined here, the owners of the cells tell what is in them.
std::vector<LeafSummary<2>> summaries_of_unrefined_leaves(const Level& level) {
  if (!level.distributed()) return {};
  const Distribution<2>& distribution = level.tree->distribution();
  const PartitionCells<2>& cells = distribution.cells();
  const BackgroundTree<2>& tree = level.tree->tree();
  const std::vector<SpacingSummary<2>> own = spacing_summaries<2>(level.map(), {});
  struct CellSummary {
    std::int32_t cell;
    SpacingSummary<2> spacing;
  };
  Bytes mine;
  for (std::int32_t c = 0; c < cells.count(); ++c) {
    if (distribution.owner_of_cell(c) != level.comm->rank()) continue;
    const std::int32_t cell = cells.tree().leaf_cell(c);
    const std::int32_t here =
        tree.cell_at(cells.tree().cell_centre(cell), cells.tree().cell(cell).depth);
    pack(mine, CellSummary{c, own[static_cast<std::size_t>(here)]});
  }
  std::vector<SpacingSummary<2>> summaries(static_cast<std::size_t>(cells.count()));
  for_records<CellSummary>({level.comm->allgather(mine)}, [&](const CellSummary& summary) {
    summaries[static_cast<std::size_t>(summary.cell)] = summary.spacing;
  });
  std::vector<LeafSummary<2>> unrefined;
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf)
    if (!distribution.refined(leaf))
      unrefined.push_back({leaf, summaries[static_cast<std::size_t>(distribution.cell_of(leaf))]});
  return unrefined;
}

// Of our steep leaves. Collective.
std::vector<Point<2>> graded_fill(const Level& level,
                                  const std::function<bool(std::int32_t)>& owned) {
  std::optional<GradedFill<2>> fill;
  std::vector<double> d;
  agreed(*level.comm, [&] {
    fill.emplace(level.map(), owned);
    d.resize(fill->centres().size());
    level.ground.evaluator()(static_cast<std::int64_t>(d.size()), fill->centres().data(), d.data());
  });
  std::int64_t end = 0;
  const std::vector<std::int64_t> before =
      level.tree->distribution().prefix_sums(*level.comm, fill->wanted_nodes(d), end);
  std::vector<Point<2>> nodes;
  agreed(*level.comm, [&] { nodes = fill->place(d, before); });
  return nodes;
}

}  // namespace

void fill(Level& level, const std::function<void()>& beat) {
  const PhaseTimer timer(level.timers, Phase::fill);
  GivenNodes inner;
  const std::vector<LeafSummary<2>> unrefined = summaries_of_unrefined_leaves(level);
  const auto owned = [&](std::int32_t leaf) {
    beat();
    return level.tree->owns(leaf);
  };
  agreed(*level.comm, [&] {
    for (const Point<2>& x :
         lattice_fill<2>(level.map(), level.ground.domain().bounds(), owned, unrefined))
      inner.push_back({x, -1});
  });
  for (const Point<2>& x : graded_fill(level, owned)) inner.push_back({x, -1});
  agreed(*level.comm, [&] {
    beat();
    find_leaves(level, inner);
    beat();
    sort_by_place(level, inner);
  });
  number_and_store(level, std::move(inner), {});
}

}  // namespace pnpbs
