// SPDX-License-Identifier: BSD-3-Clause
#include "picture/cairo_surface.hpp"
#include "picture/picture.hpp"

namespace pnpbs::picture {

void write_png(const NodeSet& nodes, const PictureStyle& style, io::Sink& sink) {
  const PictureFrame frame = frame_for(nodes);
  CairoStream stream(sink);
  const Surface surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(frame.width),
                                 static_cast<int>(frame.height)),
      cairo_surface_destroy);
  const Context cairo(cairo_create(surface.get()), cairo_destroy);
  draw_picture(cairo.get(), nodes, frame, style);
  stream.check(cairo_status(cairo.get()));
  stream.check(cairo_surface_write_to_png_stream(surface.get(), CairoStream::write, &stream));
}

}  // namespace pnpbs::picture
