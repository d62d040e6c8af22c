// SPDX-License-Identifier: BSD-3-Clause
// How many nodes d asks for, how it varies, and first nodes inside where there were none.
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/lattice.hpp"
#include "comm/records.hpp"
#include "initial/graded_fill.hpp"
#include "initial/initial_fill.hpp"
#include "level/level.hpp"

namespace pnpbs {

// Nodes that d asks for in each leaf of ours. Of the leaves that the boundary crosses we know only
// what the domain's area leaves for all of them. Collective.
std::vector<double> Level::wanted_nodes() const {
  const BackgroundTree<2>& tree = map_.tree();
  std::uint64_t inside = 0, crossed = 0;  // areas
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf)
    if (distribution_.owns(leaf) && !map_.leaf_outside(leaf))
      (map_.leaf_has_edges(leaf) ? crossed : inside) += map_.leaf_size(leaf);
  const double unit = std::pow(std::ldexp(tree.side(), -DomainMap::kMaxDepth), 2);
  const double area_inside = unit * static_cast<double>(comm_->allreduce_sum(inside)),
               area_crossed = unit * static_cast<double>(comm_->allreduce_sum(crossed));
  const double share =
      area_crossed > 0 ? std::clamp((domain_->area() - area_inside) / area_crossed, 0.0, 1.0) : 0;
  std::vector<double> wanted;
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    const double d = map_.leaf_spacing(leaf), side = tree.cell_side(tree.leaf_cell(leaf));
    const double part = !distribution_.owns(leaf) || map_.leaf_outside(leaf) ? 0
                        : map_.leaf_has_edges(leaf)                          ? share
                                                                             : 1;
    wanted.push_back(part > 0 ? part * Lattice<2>::kDensity * side * side / (d * d) : 0);
  }
  return wanted;
}

double Level::expected_nodes() const {
  std::int64_t nodes = 0;
  for (double wanted : wanted_nodes()) nodes += fixed_point(wanted);
  return from_fixed_point(comm_->allreduce_sum(static_cast<std::uint64_t>(nodes)));
}

SpacingVariation Level::spacing_variation() const {
  constexpr double kBetweenSamples = 0.7;  // the farthest of a leaf, in units of its side
  SpacingVariation own;
  for (std::int32_t leaf = 0; leaf < map_.tree().leaf_count(); ++leaf) {
    if (!distribution_.owns(leaf) || map_.leaf_outside(leaf)) continue;
    const double least = map_.leaf_least_spacing(leaf), largest = map_.leaf_largest_spacing(leaf);
    // Next to the boundary the samples may be those of the cell above.
    const double cell = map_.tree().cell_side(map_.tree().leaf_cell(leaf)),
                 way = kBetweenSamples * (map_.leaf_has_edges(leaf) ? 2 * cell : cell);
    own.least = std::min(own.least, least);
    own.largest = std::max(own.largest, largest);
    own.steepest = std::max(own.steepest, (largest - least) / way);
  }
  return {-comm_->allreduce_max(-own.least), comm_->allreduce_max(own.largest),
          comm_->allreduce_max(own.steepest)};
}

SteepestGrowth Level::steepest_growth() const {
  const PhaseTimer timer(timers_, Phase::spacing);
  return pnpbs::steepest_growth(*comm_, map_, owns_leaf(), evaluator());
}

void Level::fill(const std::function<void()>& beat) {
  const PhaseTimer timer(timers_, Phase::fill);
  GivenNodes inner;
  const std::vector<LeafSummary> unrefined = summaries_of_unrefined_leaves();
  const auto owned = [&](std::int32_t leaf) {
    beat();
    return distribution_.owns(leaf);
  };
  agreed(*comm_, [&] {
    for (const Point<2>& x : hexagonal_fill(map_, domain_->bounds(), owned, unrefined))
      inner.push_back({x, -1});
  });
  for (const Point<2>& x : graded_fill(owned)) inner.push_back({x, -1});
  agreed(*comm_, [&] {
    beat();
    find_leaves(inner);
    beat();
    sort_by_place(inner);
  });
  number_and_store(std::move(inner));
}

// Of our steep leaves. Collective.
std::vector<Point<2>> Level::graded_fill(const std::function<bool(std::int32_t)>& owned) const {
  std::optional<GradedFill> fill;
  std::vector<double> d;
  agreed(*comm_, [&] {
    fill.emplace(map_, owned);
    d.resize(fill->centres().size());
    evaluator()(static_cast<std::int64_t>(d.size()), fill->centres().data(), d.data());
  });
  std::int64_t end = 0;
  const std::vector<std::int64_t> before =
      distribution_.prefix_sums(*comm_, fill->wanted_nodes(d), end);
  std::vector<Point<2>> nodes;
  agreed(*comm_, [&] { nodes = fill->place(d, before); });
  return nodes;
}

// Where the tree is not refined here, the owners of the cells tell what is in them.
std::vector<LeafSummary> Level::summaries_of_unrefined_leaves() const {
  if (!distributed()) return {};
  const PartitionCells<2>& cells = distribution_.cells();
  const BackgroundTree<2>& tree = map_.tree();
  const std::vector<SpacingSummary> own = spacing_summaries(map_, {});
  struct CellSummary {
    std::int32_t cell;
    SpacingSummary spacing;
  };
  Bytes mine;
  for (std::int32_t c = 0; c < cells.count(); ++c) {
    if (distribution_.owner_of_cell(c) != comm_->rank()) continue;
    const std::int32_t cell = cells.tree().leaf_cell(c);
    const std::int32_t here =
        tree.cell_at(cells.tree().cell_centre(cell), cells.tree().cell(cell).depth);
    pack(mine, CellSummary{c, own[static_cast<std::size_t>(here)]});
  }
  std::vector<SpacingSummary> summaries(static_cast<std::size_t>(cells.count()));
  for_records<CellSummary>({comm_->allgather(mine)}, [&](const CellSummary& summary) {
    summaries[static_cast<std::size_t>(summary.cell)] = summary.spacing;
  });
  std::vector<LeafSummary> unrefined;
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf)
    if (!distribution_.refined(leaf))
      unrefined.push_back({leaf, summaries[static_cast<std::size_t>(distribution_.cell_of(leaf))]});
  return unrefined;
}

}  // namespace pnpbs
