// SPDX-License-Identifier: BSD-3-Clause
// The legend below every picture.
#pragma once

#include <cairo.h>

#include <cstddef>
#include <string>

#include "picture/colour_scale.hpp"
#include "picture/picture_frame.hpp"

namespace pnpbs::picture {

// Selects the font and draws a scale bar. Returns y of the base line of the legend. [pixels]
double begin_legend(cairo_t* cairo, const PictureFrame& frame, double font_size);

// Returns the font size for a legend with a colour bar. It is smaller in tall, narrow pictures.
double font_beside_colour_bar(const PictureFrame& frame);

// Draws the number of nodes at the right end of the legend.
void draw_node_count(cairo_t* cairo, const PictureFrame& frame, double base, std::size_t nodes);

// Position and size of a colour bar. [pixels]
struct ColourBarPlace {
  double left, base;  // base: base line of the tick labels
  double width;
  double font_size;
};

// Draws a colour bar with its title above and its ticks below.
void draw_colour_bar(cairo_t* cairo, const ColourScale& scale, const std::string& title,
                     const ColourBarPlace& place);

// Returns the scale in words: "title (low, ..., high)".
std::string words_of(const ColourScale& scale, const std::string& title);

}  // namespace pnpbs::picture
