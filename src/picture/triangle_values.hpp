// SPDX-License-Identifier: BSD-3-Clause
// What pictures may colour triangles by.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "picture/colour_scale.hpp"
#include "picture/node_set.hpp"

namespace pnpbs::picture {

enum class TriangleColour {
  none,
  quality,  // 2 r_in / R
  edge,     // mean of its edges' lengths, each over d, the mean of d at its ends
  spacing   // mean of d at its corners
};

std::vector<std::string> triangle_colour_names();
std::optional<TriangleColour> triangle_colour_called(std::string_view name);

class TriangleValues {
 public:
  // nodes must outlive this; by: not none.
  TriangleValues(const NodeSet& nodes, TriangleColour by);

  const NodeSet& nodes() const { return nodes_; }
  std::size_t count() const { return nodes_.triangles.size(); }
  std::array<std::size_t, 3> corners(std::size_t triangle) const;
  double at(std::size_t triangle) const;
  const ColourScale& scale() const { return scale_; }
  std::string title() const;  // what the numbers are, and from where to where they go

 private:
  void choose_scale();
  void choose_quality_scale();
  void choose_edge_scale();
  void choose_spacing_scale();

  const NodeSet& nodes_;
  TriangleColour by_;
  double min_ = 0, max_ = 0;
  ColourScale scale_;
};

}  // namespace pnpbs::picture
