// SPDX-License-Identifier: BSD-3-Clause
// The key to a scale of colours: a title, the colours, and numbers below them.
#pragma once

#include <cairo.h>

#include <string>

#include "picture/colour_scale.hpp"

namespace pnpbs::picture {

struct ColourBarPlace {
  double left, base;  // base: the line the numbers stand on
  double width;
  double font_size;
};

void draw_colour_bar(cairo_t* cairo, const ColourScale& scale, const std::string& title,
                     const ColourBarPlace& place);

// The same in words: "title (low, ..., high)".
std::string words_of(const ColourScale& scale, const std::string& title);

}  // namespace pnpbs::picture
