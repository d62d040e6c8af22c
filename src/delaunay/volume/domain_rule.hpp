// SPDX-License-Identifier: BSD-3-Clause
// Which elements are part of the domain.
#pragma once

#include <array>
#include <cstdint>

#include "delaunay/volume/element_rule.hpp"
#include "delaunay/volume/volume_stars.hpp"

namespace pnpbs {

// Of an element with these nodes at its corners: a pure function of the corners, which may be where
// the nodes mean to go. One that is flat between boundary nodes is nothing but their rounding, or
// what a curved surface rises between them.
bool in_domain(const VolumeStarInput& input, const std::array<std::int64_t, 4>& nodes,
               const Tetrahedron& corners);
// Of nodes where they are.
bool in_domain(const VolumeStarInput& input, const std::array<std::int64_t, 4>& nodes);

// Is it flat, and lies in the boundary? By its corners in the order of their ids.
bool lies_in_boundary(const VolumeStarInput& input, const Tetrahedron& ordered);

}  // namespace pnpbs
