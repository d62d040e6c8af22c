// SPDX-License-Identifier: BSD-3-Clause
// Where in the picture things are, and how large.
#pragma once

#include <initializer_list>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace pnpbs::picture {

constexpr double edges_from_spacing = 7.0;  // pixels; below, triangle edges would be a grey mist

// Lengths in pixels, except where they belong to the domain.
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

// Pixels.
struct PictureSize {
  double wanted_spacing;  // between typical nodes, if there is room
  double min_side;        // of the longer side of what is shown
  double max_side;
};

// Of points [n][2]; if there are none, of the origin.
Box<2> bounds_of(std::initializer_list<std::span<const double>> points);

// In a size that suits what is shown and the spacing of the nodes.
PictureFrame frame_around(const Box<2>& bounds, const std::vector<double>& spacing,
                          const PictureSize& size);

}  // namespace pnpbs::picture
