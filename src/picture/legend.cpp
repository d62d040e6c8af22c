// SPDX-License-Identifier: BSD-3-Clause
#include "picture/legend.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "picture/lettering.hpp"

namespace pnpbs::picture {
namespace {

// 103 214 instead of 103214.
std::string grouped(std::size_t count) {
  std::string digits = std::to_string(count);
  for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3) {
    digits.insert(static_cast<std::size_t>(at), 1, ' ');
  }
  return digits;
}

// The largest of 1, 2, 5 times a power of ten that is at most `value`.
double round_below(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  const double digit = value / power;
  return power * (digit >= 5 ? 5 : digit >= 2 ? 2 : 1);
}

void draw_scale_bar(cairo_t* cairo, const PictureFrame& frame, double left, double base) {
  const double length = round_below(frame.from_pixels(0.22 * frame.width));
  const double right = left + frame.pixels(length);
  const double tick = 0.35 * frame.font_size;
  cairo_move_to(cairo, left, base - tick);
  cairo_line_to(cairo, left, base);
  cairo_line_to(cairo, right, base);
  cairo_line_to(cairo, right, base - tick);
  set_colour(cairo, ink);
  cairo_set_line_width(cairo, 1.2 * frame.line_width);
  cairo_stroke(cairo);
  draw_text(cairo, 0.5 * (left + right), base - 0.6 * frame.font_size, short_number(length), 0.5);
}

}  // namespace

double begin_legend(cairo_t* cairo, const PictureFrame& frame, double font_size) {
  cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, font_size);
  const double base = frame.height - frame.margin;
  draw_scale_bar(cairo, frame, frame.margin, base);
  return base;
}

double font_beside_colour_bar(const PictureFrame& frame) {
  return std::min(frame.font_size, frame.width / 45);
}

void draw_node_count(cairo_t* cairo, const PictureFrame& frame, double base, std::size_t nodes) {
  draw_text(cairo, frame.width - frame.margin, base, grouped(nodes) + " nodes", 1);
}

}  // namespace pnpbs::picture
