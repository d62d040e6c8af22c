// SPDX-License-Identifier: BSD-3-Clause
#include "picture/cairo_surface.hpp"
#include "picture/formats.hpp"

namespace pnpbs::picture {

void write_png(const Drawing& drawing, io::Sink& sink) {
  CairoStream stream(sink);
  const Surface surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(drawing.width),
                                 static_cast<int>(drawing.height)),
      cairo_surface_destroy);
  const Context cairo(cairo_create(surface.get()), cairo_destroy);
  draw_on_paper(cairo.get(), drawing);
  stream.check(cairo_status(cairo.get()));
  stream.check(cairo_surface_write_to_png_stream(surface.get(), CairoStream::write, &stream));
}

}  // namespace pnpbs::picture
