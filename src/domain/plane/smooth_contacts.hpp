// SPDX-License-Identifier: BSD-3-Clause
// Where smooth curves meet others, or come close to them, their samples must know.
#pragma once

#include "domain/plane/domain_graph.hpp"

namespace pnpbs {

// A vertex, curve end or fixed node that lies on a smooth curve becomes a sample of it.
void attach_to_smooth_curves(std::vector<CurveSource>& sources,
                             const std::vector<FixedNode<2>>& fixed_nodes, double size);

// Halves the chords of smooth curves that are in conflict, which the curves themselves may not
// be. False if there are none.
bool refine_conflicting_chords(std::vector<CurveSource>& sources, const DomainGraph& graph,
                               const std::vector<SweepConflict>& conflicts);

}  // namespace pnpbs
