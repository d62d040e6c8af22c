// SPDX-License-Identifier: BSD-3-Clause
#include "picture/triangle_fill.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "picture/cairo_surface.hpp"
#include "picture/element_colour.hpp"
#include "picture/lettering.hpp"

namespace pnpbs::picture {
namespace {

TriangleShape shape_of(const NodeSet& nodes, const std::array<std::size_t, 3>& corners) {
  TriangleShape triangle{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t a = corners[k], b = corners[(k + 1) % 3];
    triangle.edge[k] =
        std::hypot(nodes.xy[2 * b] - nodes.xy[2 * a], nodes.xy[2 * b + 1] - nodes.xy[2 * a + 1]);
    triangle.spacing[k] = nodes.spacing[a];
  }
  return triangle;
}

}  // namespace

TriangleValues::TriangleValues(const NodeSet& nodes, ElementColour by) : nodes_(nodes), by_(by) {
  scale_ = scale_for(by, {count(), [this](std::size_t triangle) { return at(triangle); }});
}

std::array<std::size_t, 3> TriangleValues::corners(std::size_t triangle) const {
  const std::array<std::int64_t, 3>& ends = nodes_.triangles[triangle];
  return {static_cast<std::size_t>(ends[0]), static_cast<std::size_t>(ends[1]),
          static_cast<std::size_t>(ends[2])};
}

double TriangleValues::at(std::size_t triangle) const {
  return value_of(by_, shape_of(nodes_, corners(triangle)));
}

std::string TriangleValues::title() const {
  return title_of(by_, "quality 2 r_in / R", "triangles", scale_, count());
}

namespace {

// Limits memory, since cairo stores a path until it is filled.
constexpr std::size_t triangles_at_once = 4096;

constexpr double overlap = 0.5;  // width of the overlap of triangles. [line width]

// Returns whether the centre of a pixel may lie between both coordinates. Cairo rounds coordinates
// to 1/256 of a pixel.
bool meets_pixels(double low, double high) {
  constexpr double rounding = 1.0 / 128;
  return std::ceil(low - rounding - 0.5) <= std::floor(high + rounding - 0.5);
}

class TriangleFill {
 public:
  TriangleFill(const PictureFrame& frame, const TriangleValues& values)
      : frame_(frame), values_(values), nodes_(values.nodes()), classes_(values.count()) {
    for (std::size_t t = 0; t < classes_.size(); ++t)
      classes_[t] = static_cast<std::uint8_t>(values.scale().class_of(values.at(t)));
  }

  // Draws all triangles. `pixels`: the target is a raster image, so triangles without a pixel
  // centre are left out.
  void draw(cairo_t* cairo, bool pixels) const {
    // Antialiased edges would show the paper between two triangles. In a raster image a pixel
    // belongs to the triangle that contains its centre. In vector formats the triangles overlap a
    // little instead.
    cairo_set_antialias(cairo, CAIRO_ANTIALIAS_NONE);
    cairo_set_line_width(cairo, overlap * frame_.line_width);
    for (int c = 0; c < colour_classes; ++c) draw_class(cairo, c, pixels);
    cairo_set_antialias(cairo, CAIRO_ANTIALIAS_DEFAULT);
  }

 private:
  void draw_class(cairo_t* cairo, int index, bool pixels) const {
    set_colour(cairo, values_.scale().colour(index));
    std::size_t waiting = 0;
    for (std::size_t t = 0; t < classes_.size(); ++t) {
      if (classes_[t] != index || !add(cairo, t, pixels)) continue;
      if (++waiting < triangles_at_once) continue;
      fill(cairo, pixels);
      waiting = 0;
    }
    if (waiting > 0) fill(cairo, pixels);
  }

  static void fill(cairo_t* cairo, bool pixels) {
    if (!pixels) {
      cairo_fill_preserve(cairo);
      cairo_stroke(cairo);
    } else {
      cairo_fill(cairo);
    }
  }

  bool add(cairo_t* cairo, std::size_t triangle, bool pixels) const {
    const auto corners = values_.corners(triangle);
    double x[3], y[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t node = corners[k];
      x[k] = frame_.x(nodes_.xy[2 * node]);
      y[k] = frame_.y(nodes_.xy[2 * node + 1]);
    }
    const auto [left, right] = std::ranges::minmax(x);
    const auto [top, bottom] = std::ranges::minmax(y);
    if (pixels && !(meets_pixels(left, right) && meets_pixels(top, bottom))) return false;
    cairo_move_to(cairo, x[0], y[0]);
    cairo_line_to(cairo, x[1], y[1]);
    cairo_line_to(cairo, x[2], y[2]);
    cairo_close_path(cairo);
    return true;
  }

  const PictureFrame& frame_;
  const TriangleValues& values_;
  const NodeSet& nodes_;
  std::vector<std::uint8_t> classes_;
};

void draw_as_pixels(cairo_t* cairo, const PictureFrame& frame, const TriangleFill& fill) {
  const Surface image(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, static_cast<int>(frame.width),
                                                 static_cast<int>(frame.height)),
                      cairo_surface_destroy);
  {
    const Context pixels(cairo_create(image.get()), cairo_destroy);
    fill.draw(pixels.get(), true);
  }
  cairo_set_source_surface(cairo, image.get(), 0, 0);
  cairo_paint(cairo);
}

}  // namespace

void fill_triangles(cairo_t* cairo, const PictureFrame& frame, const TriangleValues& values) {
  const TriangleFill fill(frame, values);
  const auto type = cairo_surface_get_type(cairo_get_target(cairo));
  if (type == CAIRO_SURFACE_TYPE_IMAGE)
    fill.draw(cairo, true);
  else if (frame.pixels(frame.typical_spacing) >= edges_from_spacing)
    fill.draw(cairo, false);
  else
    draw_as_pixels(cairo, frame, fill);
}

}  // namespace pnpbs::picture
