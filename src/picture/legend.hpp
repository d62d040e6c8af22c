// SPDX-License-Identifier: BSD-3-Clause
// The line below every picture.
#pragma once

#include <cairo.h>

#include <cstddef>
#include <string>

#include "picture/colour_scale.hpp"
#include "picture/picture_frame.hpp"

namespace pnpbs::picture {

// Chooses the letters and draws a scale bar. Returns the line the legend stands on.
double begin_legend(cairo_t* cairo, const PictureFrame& frame, double font_size);

// High and narrow pictures have not room for a bar of colours beside other things in large letters.
double font_beside_colour_bar(const PictureFrame& frame);

// At the right end.
void draw_node_count(cairo_t* cairo, const PictureFrame& frame, double base, std::size_t nodes);

// The key to a scale of colours: a title, the colours, and numbers below them.
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
