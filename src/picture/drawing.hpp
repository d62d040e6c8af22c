// SPDX-License-Identifier: BSD-3-Clause
// A picture that can be drawn on any cairo surface.
#pragma once

#include <cairo.h>

#include <functional>
#include <string>

namespace pnpbs::picture {

struct Drawing {
  double width, height;     // pixels
  std::string description;  // in words, for those who search; may be empty
  std::function<void(cairo_t*)> draw;
};

}  // namespace pnpbs::picture
