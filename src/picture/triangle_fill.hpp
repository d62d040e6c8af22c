// SPDX-License-Identifier: BSD-3-Clause
// Triangles of a picture, filled with the colours of their values.
#pragma once

#include <cairo.h>

#include <array>
#include <cstddef>
#include <string>

#include "picture/element_colour.hpp"
#include "picture/node_set.hpp"
#include "picture/picture_frame.hpp"

namespace pnpbs::picture {

// The values by which the triangles of a picture are coloured, and their scale.
class TriangleValues {
 public:
  // `nodes` must outlive this object. `by` must not be `none`.
  TriangleValues(const NodeSet& nodes, ElementColour by);

  const NodeSet& nodes() const { return nodes_; }
  std::size_t count() const { return nodes_.triangles.size(); }
  std::array<std::size_t, 3> corners(std::size_t triangle) const;
  double at(std::size_t triangle) const;
  const ColourScale& scale() const { return scale_.colours; }
  std::string title() const;  // quantity and range of the values

 private:
  const NodeSet& nodes_;
  ElementColour by_;
  ValueScale scale_;
};

// Fills the triangles. Vector formats get a raster image of triangles that are too small to be
// seen, which limits the size of the file.
void fill_triangles(cairo_t* cairo, const PictureFrame& frame, const TriangleValues& values);

}  // namespace pnpbs::picture
