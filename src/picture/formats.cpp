// SPDX-License-Identifier: BSD-3-Clause
#include "picture/formats.hpp"

#include <cairo-svg.h>

#include <array>
#include <string>

#include "picture/cairo_surface.hpp"

namespace pnpbs::picture {
namespace {

// A filter that inserts a description into an SVG file. Cairo draws letters as shapes, which
// neither a search nor a screen reader finds.
class Describer {
 public:
  Describer(io::Sink& sink, const std::string& words)
      : sink_(sink), element_("\n<desc>" + words + "</desc>") {}

  void operator()(std::span<const char> part) {
    if (described_) return sink_.bytes(part.data(), part.size());
    head_.append(part.data(), part.size());
    const std::size_t root = head_.find("<svg");
    const std::size_t end = root == std::string::npos ? root : head_.find('>', root);
    if (end == std::string::npos) return;
    head_.insert(end + 1, element_);
    sink_.text(head_);
    described_ = true;
  }

 private:
  io::Sink& sink_;
  std::string element_, head_;
  bool described_ = false;
};

void write_plain(const Drawing& drawing, io::Sink& sink) {
  CairoStream stream(sink);
  const Surface surface(cairo_svg_surface_create_for_stream(CairoStream::write, &stream,
                                                            drawing.width, drawing.height),
                        cairo_surface_destroy);
  cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PX);
  {
    const Context cairo(cairo_create(surface.get()), cairo_destroy);
    draw_on_paper(cairo.get(), drawing);
    stream.check(cairo_status(cairo.get()));
  }
  cairo_surface_finish(surface.get());
  stream.check(cairo_surface_status(surface.get()));
}

void write_svg(const Drawing& drawing, io::Sink& sink) {
  if (drawing.description.empty()) return write_plain(drawing, sink);
  Describer describer(sink, drawing.description);
  io::Sink described([&describer](std::span<const char> part) { describer(part); });
  write_plain(drawing, described);
  described.flush();
}

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

constexpr std::array table{
    Format{"svg", "a picture, scalable", false, write_svg},
    Format{"png", "a picture in pixels", true, write_png},
};

}  // namespace

std::span<const Format> formats() { return table; }

}  // namespace pnpbs::picture
