// SPDX-License-Identifier: BSD-3-Clause
// The elements of this rank by local indices: owned nodes come first, then ghosts.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tool/library.hpp"

namespace pnpbs::tool {

template <std::size_t Size>
using Corners = std::array<std::int64_t, Size>;

// These functions are collective and throw Failure.
std::vector<Corners<3>> own_triangles(pnpbs_placement placement, pnpbs_context context);
std::vector<Corners<4>> own_tetrahedra(pnpbs_placement placement, pnpbs_context context);
std::vector<Corners<3>> own_boundary(pnpbs_placement placement,
                                     pnpbs_context context);  // of a body
std::vector<std::int64_t> ghost_ids(pnpbs_placement placement, pnpbs_context context);

}  // namespace pnpbs::tool
