// SPDX-License-Identifier: BSD-3-Clause
#include "partition/partition_cells.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <tuple>

#include "comm/records.hpp"

namespace pnpbs {

namespace {

// METIS balances 100 cells per rank to 3 %.
constexpr std::int64_t kCellsPerRank = 250;

using CellKey = std::tuple<std::int32_t, std::uint32_t, std::uint32_t>;

// What a rank knows of the cells of the tree above its own leaves.
struct OwnCells {
  std::vector<std::int64_t> work;
  std::vector<double> largest_spacing;
  std::vector<char> own;  // are all leaves in it this rank's?

  OwnCells(const DomainMap& map, const std::function<bool(std::int32_t)>& owns,
           const std::vector<std::int64_t>& leaf_work) {
    const BackgroundTree<2>& tree = map.tree();
    const auto cells = static_cast<std::size_t>(tree.cell_count());
    work.assign(cells, 0);
    largest_spacing.assign(cells, 0);
    own.assign(cells, 1);
    for (std::int32_t c = tree.cell_count() - 1; c >= 0; --c) {
      const auto at = static_cast<std::size_t>(c);
      const BackgroundTree<2>::Cell& cell = tree.cell(c);
      if (cell.first_child < 0) {
        own[at] = owns(cell.leaf);
        if (own[at]) work[at] = leaf_work[static_cast<std::size_t>(cell.leaf)];
        if (!map.leaf_outside(cell.leaf)) largest_spacing[at] = map.leaf_largest_spacing(cell.leaf);
        continue;
      }
      for (int k = 0; k < BackgroundTree<2>::kChildren; ++k) {
        const auto child = static_cast<std::size_t>(cell.first_child + k);
        work[at] += work[child];
        largest_spacing[at] = std::max(largest_spacing[at], largest_spacing[child]);
        own[at] = own[at] && own[child];
      }
    }
  }
};

void put_together(const BackgroundTree<2>& tree, const OwnCells& known, std::int64_t share,
                  std::int32_t c, Bytes& found) {
  const auto at = static_cast<std::size_t>(c);
  const BackgroundTree<2>::Cell& cell = tree.cell(c);
  const bool leaf = cell.first_child < 0;
  if (known.own[at] && (leaf || known.work[at] <= share)) {
    pack(found, PartitionCell{cell.index, cell.depth, known.work[at], known.largest_spacing[at]});
  } else if (!leaf) {
    for (int k = 0; k < BackgroundTree<2>::kChildren; ++k)
      put_together(tree, known, share, cell.first_child + k, found);
  }
}

}  // namespace

PartitionCells::PartitionCells(const Box<2>& bounds, const std::vector<PartitionCell>& cells) {
  std::set<CellKey> above;  // the cells that one of these lies in
  for (const PartitionCell& cell : cells) {
    CellKey key{cell.depth, cell.index[0], cell.index[1]};
    while (std::get<0>(key) > 0) {
      key = {std::get<0>(key) - 1, std::get<1>(key) / 2, std::get<2>(key) / 2};
      if (!above.insert(key).second) break;
    }
  }
  tree_.build(bounds, [&](const BackgroundTree<2>& tree, std::int32_t first, std::int32_t last,
                          std::vector<char>& split) {
    for (std::int32_t c = first; c < last; ++c) {
      const BackgroundTree<2>::Cell& cell = tree.cell(c);
      split[static_cast<std::size_t>(c - first)] =
          above.count({cell.depth, cell.index[0], cell.index[1]}) > 0;
    }
  });
  work_.assign(static_cast<std::size_t>(count()), 0);
  largest_spacing_.assign(static_cast<std::size_t>(count()), 0);
  for (const PartitionCell& cell : cells) {
    const double side = std::ldexp(tree_.side(), -cell.depth);
    const std::int32_t leaf = at({tree_.origin()[0] + side * (cell.index[0] + 0.5),
                                  tree_.origin()[1] + side * (cell.index[1] + 0.5)});
    work_[static_cast<std::size_t>(leaf)] = cell.work;
    largest_spacing_[static_cast<std::size_t>(leaf)] = cell.largest_spacing;
  }
}

std::vector<PartitionCell> cells_of_equal_work(const Communicator& comm, const DomainMap& map,
                                               const std::function<bool(std::int32_t)>& owns,
                                               const std::vector<std::int64_t>& leaf_work) {
  const OwnCells known(map, owns, leaf_work);
  std::uint64_t mine = 0;
  for (std::int32_t leaf = 0; leaf < map.tree().leaf_count(); ++leaf)
    if (owns(leaf)) mine += static_cast<std::uint64_t>(leaf_work[static_cast<std::size_t>(leaf)]);
  const auto total = static_cast<std::int64_t>(comm.allreduce_sum(mine));
  Bytes found;
  put_together(map.tree(), known, total / (kCellsPerRank * comm.size()), 0, found);
  std::vector<PartitionCell> cells;
  for_records<PartitionCell>({comm.allgather(found)},
                             [&](const PartitionCell& cell) { cells.push_back(cell); });
  return cells;
}

}  // namespace pnpbs
