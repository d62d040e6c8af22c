// SPDX-License-Identifier: BSD-3-Clause
// The elements that a rank owns, numbered.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh_records.hpp"
#include "results/results.hpp"

namespace pnpbs {

// The number of each node by its place, ghosts behind the owned ones. Collective.
std::vector<std::int64_t> node_numbers(NodalResults& results, const RankRanges& nodes);

// Those whose node with the least id this rank owns, in the order of their corners' ids. They have
// no numbers yet. After prepare_stars.
template <std::size_t Corners, int Dim>
std::vector<MeshElement<Corners>> owned_elements(const Results<Dim>& results,
                                                 const std::vector<std::int64_t>& numbers);

extern template std::vector<MeshElement<3>> owned_elements(const Results<2>&,
                                                           const std::vector<std::int64_t>&);
extern template std::vector<MeshElement<3>> owned_elements(const Results<3>&,
                                                           const std::vector<std::int64_t>&);
extern template std::vector<MeshElement<4>> owned_elements(const Results<3>&,
                                                           const std::vector<std::int64_t>&);

}  // namespace pnpbs
