// SPDX-License-Identifier: BSD-3-Clause
// The table of file formats and one writer for each.
#pragma once

#include <span>
#include <string_view>

#include "io/node_set.hpp"
#include "io/sink.hpp"

namespace pnpbs::io {

struct PictureStyle {
  bool bubbles = false;  // draw every node's bubble, a circle of diameter d
};

struct Format {
  std::string_view name;  // also the extension, without its dot
  std::string_view help;
  bool binary;  // not for terminals
  bool wants_triangles;
  bool wants_outline;
  void (*write)(const NodeSet& nodes, const PictureStyle& style, Sink& sink);
};

std::span<const Format> formats();

// nullptr if there is none.
const Format* format_by_name(std::string_view name);
const Format* format_by_extension(std::string_view path);

void write_vtu(const NodeSet& nodes, const PictureStyle& style, Sink& sink);
void write_node(const NodeSet& nodes, const PictureStyle& style, Sink& sink);
void write_csv(const NodeSet& nodes, const PictureStyle& style, Sink& sink);
void write_svg(const NodeSet& nodes, const PictureStyle& style, Sink& sink);
void write_png(const NodeSet& nodes, const PictureStyle& style, Sink& sink);

}  // namespace pnpbs::io
