// SPDX-License-Identifier: BSD-3-Clause
#include "picture/lettering.hpp"

#include <charconv>
#include <cmath>

namespace pnpbs::picture {

void set_colour(cairo_t* cairo, const Colour& colour, double opacity) {
  cairo_set_source_rgba(cairo, colour.red, colour.green, colour.blue, opacity);
}

double text_width(cairo_t* cairo, const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(cairo, text.c_str(), &extents);
  return extents.x_advance;
}

double draw_text(cairo_t* cairo, double x, double y, const std::string& text, double align) {
  const double width = text_width(cairo, text);
  const double left = x - align * width;
  cairo_move_to(cairo, left, y);
  set_colour(cairo, ink);
  cairo_show_text(cairo, text.c_str());
  return left + width;
}

std::string short_number(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 3);
  if (!(std::fabs(value) >= 1e3 && std::fabs(value) < 1e6)) return {text, end.ptr};
  // Such numbers are written without an exponent.
  double rounded = value;
  std::from_chars(text, end.ptr, rounded);
  const auto whole = std::to_chars(text, text + sizeof text, rounded, std::chars_format::fixed, 0);
  return {text, whole.ptr};
}

}  // namespace pnpbs::picture
