// SPDX-License-Identifier: BSD-3-Clause
#include "level/partitioning.hpp"

#include <cmath>
#include <cstring>
#include <map>

#include "base/lattice.hpp"
#include "comm/records.hpp"
#include "level/level_tree.hpp"
#include "partition/partition.hpp"

namespace pnpbs {

namespace {

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

// Renumbers the parts so that most of the work remains on its rank.
template <int Dim>
std::vector<std::int32_t> keep_numbers(const LevelTree<Dim>& level,
                                       const PartitionCells<Dim>& cells,
                                       std::vector<std::int32_t> part,
                                       const std::vector<std::int64_t>& work) {
  const Communicator& comm = level.comm();
  const BackgroundTree<Dim>& tree = level.tree();
  std::map<std::int32_t, std::int64_t> kept;  // work of this rank's leaves, by part
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    const std::int64_t leaf_work = work[static_cast<std::size_t>(leaf)];
    if (!level.owns(leaf) || leaf_work == 0) continue;
    const std::int32_t cell = cells.at(tree.cell_centre(tree.leaf_cell(leaf)));
    kept[part[static_cast<std::size_t>(cell)]] += leaf_work;
  }
  Bytes own;
  for (const auto& [to, kept_work] : kept) pack(own, KeptWork{kept_work, to, comm.rank()});
  std::vector<KeptWork> all;
  for_records<KeptWork>(comm.allgather(own), [&](const KeptWork& entry) { all.push_back(entry); });
  return renumbered_parts(std::move(part), std::move(all), comm.size());
}

}  // namespace

template <int Dim>
std::vector<std::int64_t> expected_work(const SizedTree<Dim>& map) {
  std::vector<std::int64_t> work;
  for (std::int32_t leaf = 0; leaf < map.tree().leaf_count(); ++leaf) {
    const double measure = map.tree().cell_measure(map.tree().leaf_cell(leaf)),
                 d = map.leaf_spacing(leaf);
    const double cell = measure / power<Dim>(d);
    const double nodes = map.leaf_outside(leaf) || d == 0 ? 0
                         : map.leaf_has_facets(leaf)      ? 0.5 * cell
                                                          : cell;
    work.push_back(map.leaf_outside(leaf)
                       ? 0
                       : 1 + static_cast<std::int64_t>(std::round(kWorkPerNode * nodes)));
  }
  return work;
}

template <int Dim>
PartitionCells<Dim> cells_of_equal_work(const LevelTree<Dim>& tree,
                                        const std::vector<std::int64_t>& work,
                                        const std::vector<std::int64_t>& rare_work) {
  const SizedTree<Dim>& map = tree.map();
  LeafFunctions leaves{
      [&](std::int32_t leaf) { return tree.owns(leaf); },
      [&](std::int32_t leaf) { return work[static_cast<std::size_t>(leaf)]; },
      [&](std::int32_t leaf) { return map.leaf_empty(leaf) ? 0 : map.leaf_max_spacing(leaf); },
      nullptr};
  if (!rare_work.empty())
    leaves.rare_work = [&](std::int32_t leaf) { return rare_work[static_cast<std::size_t>(leaf)]; };
  return {tree.geometry().tree_bounds(), cells_of_equal_work(tree.comm(), tree.tree(), leaves)};
}

template <int Dim>
std::vector<std::int32_t> cut_on_first_rank(const Communicator& comm, const Settings& settings,
                                            const PartitionCells<Dim>& cells) {
  Bytes bytes;
  collective_try(comm, [&] {
    if (comm.rank() == 0) bytes = bytes_of(cut_by_metis(cells, comm.size(), settings.metis_seed));
  });
  comm.broadcast(bytes, 0);
  return integers_of(bytes);
}

template <int Dim>
std::vector<std::int32_t> cut_like(const Communicator& comm, const Settings& settings,
                                   const Distribution<Dim>& other,
                                   const PartitionCells<Dim>& cells) {
  constexpr double kBalanced = 1.05;  // the level has few nodes, and little of the work
  std::vector<std::int32_t> owner;
  for (std::int32_t c = 0; c < cells.count(); ++c)
    owner.push_back(
        other.images().rank(other.owner_at(cells.tree().cell_centre(cells.tree().leaf_cell(c)))));
  if (pnpbs::imbalance(owner, cells.work(), comm.size()) <= kBalanced) return owner;
  return cut_on_first_rank(comm, settings, cells);
}

template <int Dim>
Distribution<Dim> redistributed(const LevelTree<Dim>& tree, const Settings& settings,
                                const std::vector<std::int64_t>& work,
                                const std::vector<std::int64_t>& rare_work) {
  const Communicator& comm = tree.comm();
  PartitionCells<Dim> cells = cells_of_equal_work(tree, work, rare_work);
  std::vector<std::int32_t> owner =
      keep_numbers(tree, cells, cut_on_first_rank(comm, settings, cells), work);
  return Distribution<Dim>(std::move(cells), std::move(owner), comm.rank(), comm.size());
}

template std::vector<std::int64_t> expected_work(const SizedTree<2>&);
template PartitionCells<2> cells_of_equal_work(const LevelTree<2>&,
                                               const std::vector<std::int64_t>&,
                                               const std::vector<std::int64_t>&);
template std::vector<std::int32_t> cut_on_first_rank(const Communicator&, const Settings&,
                                                     const PartitionCells<2>&);
template std::vector<std::int32_t> cut_like(const Communicator&, const Settings&,
                                            const Distribution<2>&, const PartitionCells<2>&);
template Distribution<2> redistributed(const LevelTree<2>&, const Settings&,
                                       const std::vector<std::int64_t>&,
                                       const std::vector<std::int64_t>&);
template std::vector<std::int64_t> expected_work(const SizedTree<3>&);
template PartitionCells<3> cells_of_equal_work(const LevelTree<3>&,
                                               const std::vector<std::int64_t>&,
                                               const std::vector<std::int64_t>&);
template std::vector<std::int32_t> cut_on_first_rank(const Communicator&, const Settings&,
                                                     const PartitionCells<3>&);
template std::vector<std::int32_t> cut_like(const Communicator&, const Settings&,
                                            const Distribution<3>&, const PartitionCells<3>&);
template Distribution<3> redistributed(const LevelTree<3>&, const Settings&,
                                       const std::vector<std::int64_t>&,
                                       const std::vector<std::int64_t>&);

}  // namespace pnpbs
