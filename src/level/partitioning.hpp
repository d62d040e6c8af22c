// SPDX-License-Identifier: BSD-3-Clause
// The partition of a level: cells of the background tree, distributed by their work.
#pragma once

#include <cstdint>
#include <vector>

#include "comm/communicator.hpp"
#include "partition/distribution.hpp"
#include "settings/settings.hpp"
#include "spacing/sized_tree.hpp"

namespace pnpbs {

template <int Dim>
class LevelTree;

constexpr double kWorkPerNode = 16;  // work of a node in estimates

// Returns the work expected in each leaf, by the number of nodes that d requires. A leaf that the
// boundary crosses counts by half.
template <int Dim>
std::vector<std::int64_t> expected_work(const SizedTree<Dim>& map);

// Returns cells of nearly equal work, from the work in each owned leaf, and their rare work, if
// that is given. Collective.
template <int Dim>
PartitionCells<Dim> cells_of_equal_work(const LevelTree<Dim>& tree,
                                        const std::vector<std::int64_t>& work,
                                        const std::vector<std::int64_t>& rare_work = {});

// Returns the owners of the cells from METIS. Rank 0 computes them and broadcasts them. All ranks
// must call it, and if one rank throws, all ranks throw.
template <int Dim>
std::vector<std::int32_t> cut_on_first_rank(const Communicator& comm, const Settings& settings,
                                            const PartitionCells<Dim>& cells);

// Returns the owners of the cells as on another level if that balances the work, so that nodes
// passed from one level to the next stay on their rank. Otherwise calls cut_on_first_rank().
// Collective.
template <int Dim>
std::vector<std::int32_t> cut_like(const Communicator& comm, const Settings& settings,
                                   const Distribution<Dim>& other,
                                   const PartitionCells<Dim>& cells);

// Returns a new partition by the work in each owned leaf, which also balances the rare work, if
// that is given. Parts are numbered so that most of the work stays on its rank. Collective.
template <int Dim>
Distribution<Dim> redistributed(const LevelTree<Dim>& tree, const Settings& settings,
                                const std::vector<std::int64_t>& work,
                                const std::vector<std::int64_t>& rare_work = {});

}  // namespace pnpbs
