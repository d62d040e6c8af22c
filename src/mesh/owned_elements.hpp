// SPDX-License-Identifier: BSD-3-Clause
// Elements that a rank owns, and the global numbers of nodes.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh_records.hpp"
#include "results/results.hpp"

namespace pnpbs {

// Returns the number of each node by its index in the results. Ghosts come after the owned nodes.
// Collective.
std::vector<std::int64_t> node_numbers(NodalResults& results, const RankRanges& nodes);

// Returns the elements whose corner with the smallest id this rank owns, sorted by the ids of their
// corners. Their numbers are not set. prepare_stars() must have been called.
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
