// SPDX-License-Identifier: BSD-3-Clause
// Values of one triangle, by its edges and d at its corners.
#pragma once

#include <array>

#include "picture/element_colour.hpp"

namespace pnpbs::picture {

struct TriangleShape {
  std::array<double, 3> edge;     // edge k is from corner k to the next
  std::array<double, 3> spacing;  // at the corners
};

// by: not none.
double value_of(ElementColour by, const TriangleShape& triangle);

}  // namespace pnpbs::picture
