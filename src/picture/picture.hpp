// SPDX-License-Identifier: BSD-3-Clause
// The picture, drawn on any cairo surface.
#pragma once

#include <cairo.h>

#include "picture/formats.hpp"
#include "picture/node_set.hpp"

namespace pnpbs::picture {

constexpr double edges_from_spacing = 7.0;  // pixels; below, triangle edges would be a grey mist

// Where the domain lies in the picture, and how large things are. Lengths in pixels, except
// where they belong to the domain.
struct PictureFrame {
  double width, height;  // of the whole picture
  double margin;
  double line_width;
  double font_size;
  double typical_spacing;  // of the domain

  double low_x, high_y;  // corner of the domain that is at the upper left
  double left, top;      // where that corner is
  double pixels_per_unit;

  double x(double domain_x) const { return left + pixels_per_unit * (domain_x - low_x); }
  double y(double domain_y) const { return top + pixels_per_unit * (high_y - domain_y); }
  double pixels(double length) const { return pixels_per_unit * length; }
  double from_pixels(double length) const { return length / pixels_per_unit; }
};

// A size that suits domain and number of nodes.
PictureFrame frame_for(const NodeSet& nodes);

void draw_picture(cairo_t* cairo, const NodeSet& nodes, const PictureFrame& frame,
                  const PictureStyle& style);

}  // namespace pnpbs::picture
