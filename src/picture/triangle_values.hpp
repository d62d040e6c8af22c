// SPDX-License-Identifier: BSD-3-Clause
// The values that pictures colour triangles by.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "picture/element_colour.hpp"
#include "picture/node_set.hpp"

namespace pnpbs::picture {

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

}  // namespace pnpbs::picture
