// SPDX-License-Identifier: BSD-3-Clause
// The partition of a level: cells of the background tree, distributed by the work in them.
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

constexpr double kWorkPerNode = 16;  // in estimates

// Of each leaf, by the nodes that d asks for; half of a leaf that the boundary crosses.
template <int Dim>
std::vector<std::int64_t> expected_work(const SizedTree<Dim>& map);

// By the work in each leaf of ours. Collective.
template <int Dim>
PartitionCells<Dim> cells_of_equal_work(const LevelTree<Dim>& tree,
                                        const std::vector<std::int64_t>& work);

// The owners of cells: those that METIS finds, the same on every rank. Collective.
template <int Dim>
std::vector<std::int32_t> cut_on_first_rank(const Communicator& comm, const Settings& settings,
                                            const PartitionCells<Dim>& cells);

// Those that they have on another level, where that balances the work: what one level hands on to
// the next then stays where it is. Collective.
template <int Dim>
std::vector<std::int32_t> cut_like(const Communicator& comm, const Settings& settings,
                                   const Distribution<Dim>& other,
                                   const PartitionCells<Dim>& cells);

// Another partition, by the work counted in each leaf of ours; most of it stays where it is.
// Collective.
template <int Dim>
Distribution<Dim> redistributed(const LevelTree<Dim>& tree, const Settings& settings,
                                const std::vector<std::int64_t>& work);

}  // namespace pnpbs
