// SPDX-License-Identifier: BSD-3-Clause
#include "picture/legend.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "picture/lettering.hpp"

namespace pnpbs::picture {
namespace {

// Returns the number with a space between groups of three digits: 103 214.
std::string grouped(std::size_t count) {
  std::string digits = std::to_string(count);
  for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3) {
    digits.insert(static_cast<std::size_t>(at), 1, ' ');
  }
  return digits;
}

// Returns the largest of 1, 2, 5 times a power of ten that is at most `value`.
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
  const std::string unit = frame.unit.empty() ? "" : " " + frame.unit;
  draw_text(cairo, 0.5 * (left + right), base - 0.6 * frame.font_size, short_number(length) + unit,
            0.5);
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

namespace {

// Layout of the colour bar: heights above the base line and lengths. [font size]
constexpr double bar_bottom = 1.05;
constexpr double bar_top = 1.6;
constexpr double title_base = 2.0;
constexpr double tick_length = 0.18;
constexpr double tip_length = 0.6;

void draw_colours(cairo_t* cairo, const ColourScale& scale, const ColourBarPlace& place) {
  const double top = place.base - bar_top * place.font_size;
  const double height = (bar_top - bar_bottom) * place.font_size;
  cairo_pattern_t* gradient =
      cairo_pattern_create_linear(place.left, 0, place.left + place.width, 0);
  for (int c = 0; c < colour_classes; ++c) {
    // A uniform scale has a single colour.
    const Colour colour = scale.colour(scale.uniform() ? colour_classes / 2 : c);
    cairo_pattern_add_color_stop_rgb(gradient, (c + 0.5) / colour_classes, colour.red, colour.green,
                                     colour.blue);
  }
  cairo_rectangle(cairo, place.left, top, place.width, height);
  cairo_set_source(cairo, gradient);
  cairo_fill(cairo);
  cairo_pattern_destroy(gradient);
}

// Draws a tip at an end of the bar: values beyond this end have its colour. direction: -1 left, 1
// right.
void draw_tip(cairo_t* cairo, double x, double direction, const Colour& colour,
              const ColourBarPlace& place) {
  const double top = place.base - bar_top * place.font_size;
  const double bottom = place.base - bar_bottom * place.font_size;
  cairo_move_to(cairo, x, top);
  cairo_line_to(cairo, x + direction * tip_length * place.font_size, 0.5 * (top + bottom));
  cairo_line_to(cairo, x, bottom);
  cairo_close_path(cairo);
  set_colour(cairo, colour);
  cairo_fill(cairo);
}

void draw_ticks(cairo_t* cairo, const ColourScale& scale, const ColourBarPlace& place) {
  const double bottom = place.base - bar_bottom * place.font_size;
  for (const double tick : scale.ticks()) {
    const double x = place.left + scale.fraction(tick) * place.width;
    cairo_move_to(cairo, x, bottom);
    cairo_line_to(cairo, x, bottom + tick_length * place.font_size);
    set_colour(cairo, ink);
    cairo_set_line_width(cairo, 0.06 * place.font_size);
    cairo_stroke(cairo);
    draw_text(cairo, x, place.base, short_number(tick), 0.5);
  }
}

}  // namespace

void draw_colour_bar(cairo_t* cairo, const ColourScale& scale, const std::string& title,
                     const ColourBarPlace& place) {
  // In narrow pictures the title is shrunk to the width of the bar.
  const double fit = std::min(1.0, place.width / text_width(cairo, title));
  cairo_set_font_size(cairo, fit * place.font_size);
  draw_text(cairo, place.left + 0.5 * place.width, place.base - title_base * place.font_size, title,
            0.5);
  draw_ticks(cairo, scale, place);
  cairo_set_font_size(cairo, place.font_size);
  draw_colours(cairo, scale, place);
  if (scale.below) draw_tip(cairo, place.left, -1, scale.colour(0), place);
  if (scale.above)
    draw_tip(cairo, place.left + place.width, 1, scale.colour(colour_classes - 1), place);
}

std::string words_of(const ColourScale& scale, const std::string& title) {
  std::string numbers;
  for (const double tick : scale.ticks())
    numbers += (numbers.empty() ? "" : ", ") + short_number(tick);
  return title + " (" + numbers + ")";
}

}  // namespace pnpbs::picture
