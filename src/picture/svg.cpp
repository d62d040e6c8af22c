// SPDX-License-Identifier: BSD-3-Clause
#include <cairo-svg.h>

#include "picture/cairo_surface.hpp"
#include "picture/picture.hpp"

namespace pnpbs::picture {

void write_svg(const NodeSet& nodes, const PictureStyle& style, io::Sink& sink) {
  const PictureFrame frame = frame_for(nodes);
  CairoStream stream(sink);
  const Surface surface(
      cairo_svg_surface_create_for_stream(CairoStream::write, &stream, frame.width, frame.height),
      cairo_surface_destroy);
  cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PX);
  {
    const Context cairo(cairo_create(surface.get()), cairo_destroy);
    draw_picture(cairo.get(), nodes, frame, style);
    stream.check(cairo_status(cairo.get()));
  }
  cairo_surface_finish(surface.get());
  stream.check(cairo_surface_status(surface.get()));
}

}  // namespace pnpbs::picture
