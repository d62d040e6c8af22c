// SPDX-License-Identifier: BSD-3-Clause
// Colours and text of pictures.
#pragma once

#include <cairo.h>

#include <string>

#include "picture/palette.hpp"

namespace pnpbs::picture {

void set_colour(cairo_t* cairo, const Colour& colour, double opacity = 1);

// Draws text at x with alignment 0 (starts at x), 0.5 (centred) or 1 (ends at x). Returns the x at
// which the text ends. [pixels]
double draw_text(cairo_t* cairo, double x, double y, const std::string& text, double align);
double text_width(cairo_t* cairo, const std::string& text);

std::string short_number(double value);  // three significant digits

}  // namespace pnpbs::picture
