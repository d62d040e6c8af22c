// SPDX-License-Identifier: BSD-3-Clause
// File formats of pictures.
#pragma once

#include <cairo.h>

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "io/sink.hpp"

namespace pnpbs::picture {

// A picture that can be drawn on any cairo surface.
struct Drawing {
  double width, height;     // pixels
  std::string description;  // for searches and screen readers; may be empty
  std::function<void(cairo_t*)> draw;
};

struct Format {
  std::string_view name;  // also the file extension, without its dot
  std::string_view help;
  bool binary;  // must not be written to a terminal
  void (*write)(const Drawing& drawing, io::Sink& sink);
};

std::span<const Format> formats();

}  // namespace pnpbs::picture
