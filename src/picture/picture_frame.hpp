// SPDX-License-Identifier: BSD-3-Clause
// Placement and scale of a domain in a picture.
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "base/types.hpp"

namespace pnpbs::picture {

// Smallest spacing with triangle edges; edges of smaller triangles would blur to grey. [pixels]
constexpr double edges_from_spacing = 7.0;

// Mapping from the domain to the picture, and sizes of its parts. Lengths are in pixels unless they
// are named lengths of the domain.
struct PictureFrame {
  double width, height;  // of the whole picture
  double margin;
  double line_width;
  double font_size;
  double typical_spacing;  // median of d, in units of the domain
  std::string unit;        // of lengths of the domain; may be empty

  double low_x, high_y;  // upper left corner of the domain, in units of the domain
  double left, top;      // position of this corner in the picture
  double pixels_per_unit;

  double x(double domain_x) const { return left + pixels_per_unit * (domain_x - low_x); }
  double y(double domain_y) const { return top + pixels_per_unit * (high_y - domain_y); }
  double pixels(double length) const { return pixels_per_unit * length; }
  double from_pixels(double length) const { return length / pixels_per_unit; }
};

// The limits of the size of a picture. [pixels]
struct PictureSize {
  double target_spacing;  // distance between typical nodes, within the limits of the sides
  double min_side;        // limits of the longer side of the domain
  double max_side;
};

// Returns the bounding box of points [n][2], or the origin if none exist.
Box<2> bounds_of(std::initializer_list<std::span<const double>> points);

// Returns a frame around `bounds`, scaled so that the median of `spacing` has the requested size.
PictureFrame frame_around(const Box<2>& bounds, const std::vector<double>& spacing,
                          const PictureSize& size, const std::string& unit);

}  // namespace pnpbs::picture
