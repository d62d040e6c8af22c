// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "domain/plane/domain_graph.hpp"
#include "geometry/plane/chains.hpp"

namespace pnpbs {

// For each chain 1 if it is closed, of less extent than `smallest` times the mean d at its
// vertices, and nothing that stays lies within. `d` and `may_go` have an entry for each vertex; the
// chain of the largest extent stays.
std::vector<char> small_loops(const DomainGraph& graph, const std::vector<Chain>& chains,
                              const std::vector<double>& d, const std::vector<char>& may_go,
                              double smallest);

// Does the point lie within a closed chain?
bool is_within(const Point<2>& point, const Chain& chain, const DomainGraph& graph);

}  // namespace pnpbs
