// SPDX-License-Identifier: BSD-3-Clause
// Output of cairo to a sink. Cairo is written in C, so exceptions of the sink must not pass through
// it. They are stored and thrown again afterwards.
#pragma once

#include <cairo.h>

#include <exception>
#include <memory>
#include <stdexcept>
#include <string>

#include "io/sink.hpp"
#include "picture/formats.hpp"
#include "picture/lettering.hpp"

namespace pnpbs::picture {

// Callback and status check for a surface that writes to a sink.
class CairoStream {
 public:
  explicit CairoStream(io::Sink& sink) : sink_(sink) {}

  static cairo_status_t write(void* self, const unsigned char* data, unsigned int length) {
    auto* stream = static_cast<CairoStream*>(self);
    try {
      stream->sink_.bytes(data, length);
      return CAIRO_STATUS_SUCCESS;
    } catch (...) {
      stream->failure_ = std::current_exception();
      return CAIRO_STATUS_WRITE_ERROR;
    }
  }

  void check(cairo_status_t status) const {
    if (failure_) std::rethrow_exception(failure_);
    if (status != CAIRO_STATUS_SUCCESS) {
      throw std::runtime_error(std::string("cannot draw the picture: ") +
                               cairo_status_to_string(status));
    }
  }

 private:
  io::Sink& sink_;
  std::exception_ptr failure_;
};

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

inline void draw_on_paper(cairo_t* cairo, const Drawing& drawing) {
  set_colour(cairo, paper);
  cairo_paint(cairo);
  drawing.draw(cairo);
}

}  // namespace pnpbs::picture
