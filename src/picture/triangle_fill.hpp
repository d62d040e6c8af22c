// SPDX-License-Identifier: BSD-3-Clause
// The triangles of a picture in the colours of their values.
#pragma once

#include <cairo.h>

#include <array>
#include <cstddef>
#include <string>

#include "picture/element_colour.hpp"
#include "picture/node_set.hpp"
#include "picture/picture_frame.hpp"

namespace pnpbs::picture {

// The values that pictures colour triangles by.
class TriangleValues {
 public:
  // nodes must outlive this; by: not none.
  TriangleValues(const NodeSet& nodes, ElementColour by);

  const NodeSet& nodes() const { return nodes_; }
  std::size_t count() const { return nodes_.triangles.size(); }
  std::array<std::size_t, 3> corners(std::size_t triangle) const;
  double at(std::size_t triangle) const;
  const ColourScale& scale() const { return scale_.colours; }
  std::string title() const;  // what the numbers are, and from where to where they go

 private:
  const NodeSet& nodes_;
  ElementColour by_;
  ValueScale scale_;
};

// Where triangles are too small to be seen, pictures that are no pixels take them as pixels, too:
// their size is bounded then.
void fill_triangles(cairo_t* cairo, const PictureFrame& frame, const TriangleValues& values);

}  // namespace pnpbs::picture
