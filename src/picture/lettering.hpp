// SPDX-License-Identifier: BSD-3-Clause
// Colours and words on a picture.
#pragma once

#include <cairo.h>

#include <string>

#include "picture/palette.hpp"

namespace pnpbs::picture {

void set_colour(cairo_t* cairo, const Colour& colour, double opacity = 1);

// align: 0 begins at x, 0.5 is centred there, 1 ends there. Returns where the text ends.
double draw_text(cairo_t* cairo, double x, double y, const std::string& text, double align);
double text_width(cairo_t* cairo, const std::string& text);

std::string short_number(double value);  // three digits: enough for a legend

}  // namespace pnpbs::picture
