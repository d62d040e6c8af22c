// SPDX-License-Identifier: BSD-3-Clause
// Quantities that pictures colour triangles and tetrahedra by, and scales for their values.
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
  edge,     // mean over the edges of length over d, with d the mean of both ends
  spacing   // mean of d at the corners
};

std::vector<std::string> element_colour_names();
std::optional<ElementColour> element_colour_called(std::string_view name);

// The values of `count` elements by index.
struct ElementValues {
  std::size_t count;
  std::function<double(std::size_t)> at;
};

// The range of the values, and the colour scale chosen for it.
struct ValueScale {
  double min = 0, max = 0;
  ColourScale colours;
};

// Returns the range and a suitable scale. `by` must not be `none`.
ValueScale scale_for(ElementColour by, const ElementValues& values);

// Returns the title of the colour bar: the quantity and the range of its values.
std::string title_of(ElementColour by, const std::string& quality, const std::string& elements,
                     const ValueScale& scale, std::size_t count);

struct TriangleShape {
  std::array<double, 3> edge;     // edge k runs from corner k to the next
  std::array<double, 3> spacing;  // at the corners
};

// Returns the value of a triangle. `by` must not be `none`.
double value_of(ElementColour by, const TriangleShape& triangle);

}  // namespace pnpbs::picture
