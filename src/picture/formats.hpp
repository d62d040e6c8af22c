// SPDX-License-Identifier: BSD-3-Clause
// The table of picture formats and one writer for each.
#pragma once

#include <span>
#include <string_view>

#include "io/sink.hpp"
#include "picture/drawing.hpp"

namespace pnpbs::picture {

struct Format {
  std::string_view name;  // also the extension, without its dot
  std::string_view help;
  bool binary;  // not for terminals
  void (*write)(const Drawing& drawing, io::Sink& sink);
};

std::span<const Format> formats();

void write_svg(const Drawing& drawing, io::Sink& sink);
void write_png(const Drawing& drawing, io::Sink& sink);

}  // namespace pnpbs::picture
