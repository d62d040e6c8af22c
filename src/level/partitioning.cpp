// SPDX-License-Identifier: BSD-3-Clause
// The partition of a level: cells of the background tree, distributed by the work in them.
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>

#include "base/lattice.hpp"
#include "comm/records.hpp"
#include "level/level_tree.hpp"
#include "partition/partition.hpp"

namespace pnpbs {

namespace {

constexpr double kWorkPerNode = 16;  // in estimates

Bytes bytes_of(const std::vector<std::int32_t>& values) {
  Bytes bytes(values.size() * sizeof(std::int32_t));
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

std::vector<std::int32_t> integers_of(const Bytes& bytes) {
  std::vector<std::int32_t> values(bytes.size() / sizeof(std::int32_t));
  if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

}  // namespace

// By a few samples of d.
template <int Dim>
void LevelTree<Dim>::take_rough_cells(const Settings& settings) {
  PartitionCells<Dim> cells(ground_.bounds(), rough_cells(settings));
  std::vector<std::int32_t> owner = cut_morton_order(cells.work(), comm_.size());
  distribution_ = Distribution<Dim>(std::move(cells), std::move(owner), comm_.rank());
}

// What one level hands on to the next then stays where it is.
template <int Dim>
std::vector<std::int32_t> LevelTree<Dim>::cut_like(const Settings& settings,
                                                   const Distribution<Dim>& other,
                                                   const PartitionCells<Dim>& cells) const {
  constexpr double kBalanced = 1.05;  // a coarse level has few nodes, and little of the work
  std::vector<std::int32_t> owner;
  for (std::int32_t c = 0; c < cells.count(); ++c)
    owner.push_back(other.owner_at(cells.tree().cell_centre(cells.tree().leaf_cell(c))));
  if (pnpbs::imbalance(owner, cells.work(), comm_.size()) <= kBalanced) return owner;
  return cut_on_first_rank(settings, cells);
}

template <int Dim>
PartitionCells<Dim> LevelTree<Dim>::cells_of_equal_work(
    const std::vector<std::int64_t>& work) const {
  const LeafFunctions leaves{
      [this](std::int32_t leaf) { return owns(leaf); },
      [&](std::int32_t leaf) { return work[static_cast<std::size_t>(leaf)]; },
      [this](std::int32_t leaf) {
        return map_.leaf_empty(leaf) ? 0 : map_.leaf_max_spacing(leaf);
      }};
  return {ground_.bounds(), pnpbs::cells_of_equal_work(comm_, tree(), leaves)};
}

// From samples of d in large cells, the same on every rank: enough to begin with.
template <int Dim>
std::vector<PartitionCell<Dim>> LevelTree<Dim>::rough_cells(const Settings& settings) {
  constexpr int kUniformDepth = 3, kPasses = 3, kCellsPerRank = 32;
  double max = std::numeric_limits<double>::infinity();
  std::vector<std::int64_t> work;
  for (int pass = 0; pass < kPasses; ++pass) {
    map_.build_part(
        comm_, ground_.bounds(), ground_.boundary(), ground_.evaluator(), settings.node_limit(),
        [&](const BackgroundTree<Dim>& tree, std::int32_t c, double nodes) {
          return tree.cell(c).depth < kUniformDepth || nodes > max;
        },
        kLevelRefinement<Dim>);
    work = expected_work();
    max = static_cast<double>(std::accumulate(work.begin(), work.end(), std::int64_t{0})) /
          (kWorkPerNode * kCellsPerRank * comm_.size());
  }
  std::vector<PartitionCell<Dim>> cells;
  for (std::int32_t leaf = 0; leaf < map_.tree().leaf_count(); ++leaf) {
    const typename BackgroundTree<Dim>::Cell& cell = map_.tree().cell(map_.tree().leaf_cell(leaf));
    cells.push_back({cell.index, cell.depth, work[static_cast<std::size_t>(leaf)],
                     map_.leaf_max_spacing(leaf)});
  }
  return cells;
}

// Of each leaf, by the nodes that d asks for; half of a leaf that the boundary crosses.
template <int Dim>
std::vector<std::int64_t> LevelTree<Dim>::expected_work() const {
  std::vector<std::int64_t> work;
  for (std::int32_t leaf = 0; leaf < map_.tree().leaf_count(); ++leaf) {
    const double side = map_.tree().cell_side(map_.tree().leaf_cell(leaf)),
                 d = map_.leaf_spacing(leaf);
    const double cell = power<Dim>(side) / power<Dim>(d);
    const double nodes = map_.leaf_outside(leaf) || d == 0 ? 0
                         : map_.leaf_has_facets(leaf)      ? 0.5 * cell
                                                           : cell;
    work.push_back(map_.leaf_outside(leaf)
                       ? 0
                       : 1 + static_cast<std::int64_t>(std::round(kWorkPerNode * nodes)));
  }
  return work;
}

template <int Dim>
std::vector<std::int32_t> LevelTree<Dim>::cut_on_first_rank(
    const Settings& settings, const PartitionCells<Dim>& cells) const {
  Bytes bytes;
  agreed(comm_, [&] {
    if (comm_.rank() == 0) bytes = bytes_of(cut_by_metis(cells, comm_.size(), settings.metis_seed));
  });
  comm_.broadcast(bytes, 0);
  return integers_of(bytes);
}

template <int Dim>
Distribution<Dim> LevelTree<Dim>::redistributed(const Settings& settings,
                                                const std::vector<std::int64_t>& work) const {
  PartitionCells<Dim> cells = cells_of_equal_work(work);
  std::vector<std::int32_t> owner = keep_numbers(cells, cut_on_first_rank(settings, cells), work);
  return Distribution<Dim>(std::move(cells), std::move(owner), comm_.rank());
}

// Parts get the numbers that let most of the work stay where it is.
template <int Dim>
std::vector<std::int32_t> LevelTree<Dim>::keep_numbers(
    const PartitionCells<Dim>& cells, std::vector<std::int32_t> part,
    const std::vector<std::int64_t>& work) const {
  std::map<std::int32_t, std::int64_t> kept;  // of ours, by part
  for (std::int32_t leaf = 0; leaf < tree().leaf_count(); ++leaf) {
    const std::int64_t leaf_work = work[static_cast<std::size_t>(leaf)];
    if (!owns(leaf) || leaf_work == 0) continue;
    const std::int32_t cell = cells.at(tree().cell_centre(tree().leaf_cell(leaf)));
    kept[part[static_cast<std::size_t>(cell)]] += leaf_work;
  }
  Bytes own;
  for (const auto& [to, kept_work] : kept) pack(own, KeptWork{kept_work, to, comm_.rank()});
  std::vector<KeptWork> all;
  for_records<KeptWork>({comm_.allgather(own)},
                        [&](const KeptWork& entry) { all.push_back(entry); });
  return relabelled(std::move(part), std::move(all), comm_.size());
}

// Of the members defined here.
template class LevelTree<2>;
template class LevelTree<3>;

}  // namespace pnpbs
