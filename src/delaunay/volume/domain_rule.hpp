// SPDX-License-Identifier: BSD-3-Clause
// Decides which elements are part of the domain.
#pragma once

#include <array>
#include <cstdint>

#include "delaunay/volume/element_rule.hpp"
#include "delaunay/volume/volume_stars.hpp"

namespace pnpbs {

// Returns whether an element with these nodes at its corners is part of the domain. The result is a
// pure function of the corners, which can be the positions to which the nodes are about to move. A
// flat element between boundary nodes is not part of it: it results from rounding, or fills the gap
// between a curved surface and the facets between its nodes.
bool in_domain(const VolumeStarInput& input, const std::array<std::int64_t, 4>& nodes,
               const Tetrahedron& corners);
// Returns the same for the present positions of the nodes.
bool in_domain(const VolumeStarInput& input, const std::array<std::int64_t, 4>& nodes);

// Returns whether the element is flat and lies in the boundary. The corners must be in the order of
// their ids.
bool lies_in_boundary(const VolumeStarInput& input, const Tetrahedron& ordered);

}  // namespace pnpbs
