// SPDX-License-Identifier: BSD-3-Clause
// Initial inner nodes (section 2.1 of the paper): a hexagonal lattice, that is rhombic cells of 60
// and 120 degrees. Where d varies, patches of the background tree over which it is nearly constant
// each have their own lattice, all of one orientation and anchored in one point.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/domain_map.hpp"

namespace pnpbs {

// Of the leaves for which wanted(leaf) holds, in their Morton order.
std::vector<Point<2>> hexagonal_fill(const DomainMap& map, const Box<2>& bounds,
                                     const std::function<bool(std::int32_t)>& wanted);

}  // namespace pnpbs
