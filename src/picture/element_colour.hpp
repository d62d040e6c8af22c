// SPDX-License-Identifier: BSD-3-Clause
// What pictures may colour triangles and tetrahedra by, and the scale that suits their values.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "picture/colour_scale.hpp"

namespace pnpbs::picture {

enum class ElementColour {
  none,
  quality,  // 2 r_in / R of triangles, 3 r_in / R of tetrahedra
  edge,     // mean of its edges' lengths, each over d, the mean of d at its ends
  spacing   // mean of d at its corners
};

std::vector<std::string> element_colour_names();
std::optional<ElementColour> element_colour_called(std::string_view name);

// The values of `count` elements, each by its number.
struct ElementValues {
  std::size_t count;
  std::function<double(std::size_t)> at;
};

struct ValueScale {
  double min = 0, max = 0;
  ColourScale colours;
};

// by: not none.
ValueScale scale_for(ElementColour by, const ElementValues& values);

// What the numbers are, and from where to where they go.
std::string title_of(ElementColour by, const std::string& quality, const std::string& elements,
                     const ValueScale& scale, std::size_t count);

struct TriangleShape {
  std::array<double, 3> edge;     // edge k is from corner k to the next
  std::array<double, 3> spacing;  // at the corners
};

// by: not none.
double value_of(ElementColour by, const TriangleShape& triangle);

}  // namespace pnpbs::picture
