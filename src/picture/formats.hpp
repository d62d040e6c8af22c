// SPDX-License-Identifier: BSD-3-Clause
// The table of picture formats and one writer for each.
#pragma once

#include <span>
#include <string_view>

#include "io/sink.hpp"
#include "picture/node_set.hpp"
#include "picture/triangle_values.hpp"

namespace pnpbs::picture {

struct PictureStyle {
  bool bubbles = false;                          // draw every node's bubble, a circle of diameter d
  TriangleColour colour = TriangleColour::none;  // otherwise triangles instead of nodes
};

struct Format {
  std::string_view name;  // also the extension, without its dot
  std::string_view help;
  bool binary;  // not for terminals
  void (*write)(const NodeSet& nodes, const PictureStyle& style, io::Sink& sink);
};

std::span<const Format> formats();

void write_svg(const NodeSet& nodes, const PictureStyle& style, io::Sink& sink);
void write_png(const NodeSet& nodes, const PictureStyle& style, io::Sink& sink);

}  // namespace pnpbs::picture
