// SPDX-License-Identifier: BSD-3-Clause
// Picture of the triangles of a sphere: the near side in an orthographic view, or all triangles on
// a map of longitude and latitude.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "base/space_vectors.hpp"
#include "picture/cairo_surface.hpp"
#include "picture/element_colour.hpp"
#include "picture/legend.hpp"
#include "picture/lettering.hpp"
#include "picture/palette.hpp"
#include "picture/picture.hpp"
#include "sphere/degrees.hpp"

namespace pnpbs::picture {
namespace {

constexpr PictureSize sphere_picture_size{12, 1400, 2400};
constexpr Colour bare = colour(0xe9e4d8);  // colour of the sphere where there are no triangles
constexpr Colour plain = colour(0xb9cadb);

using Shape = std::vector<Point<2>>;

class SpherePainter {
 public:
  SpherePainter(const Body& body, const SphereView& view, const PictureStyle& style)
      : body_(body), view_(view), by_(style.colour) {
    set_directions();
    if (by_ != ElementColour::none)
      scale_ = scale_for(by_, {body.boundary.size(), [this](std::size_t t) { return value(t); }});
    const double size = view.as_map ? 180 : view.radius;
    std::vector<double> spacing = body.spacing;
    if (view.as_map)
      for (double& d : spacing) d /= view.radius * kDegree;
    const double high = view.as_map ? 90 : size;
    frame_ = frame_around({{-size, -high}, {size, high}}, spacing, sphere_picture_size,
                          view.as_map ? "degrees" : style.unit);
  }

  const PictureFrame& frame() const { return frame_; }
  std::string description() const {
    const std::string what = view_.as_map ? "Map of a sphere" : "Triangles on a sphere";
    return scale_ ? what + ", " + words_of(scale_->colours, title()) : what;
  }

  void draw(cairo_t* cairo) const {
    draw_ground(cairo);
    cairo_set_line_width(cairo, 0.6 * frame_.line_width);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_save(cairo);
    if (view_.as_map) clip(cairo);
    for (std::size_t t = 0; t < body_.boundary.size(); ++t)
      view_.as_map ? draw_on_map(cairo, t) : draw_seen(cairo, t);
    draw_graticule(cairo);
    cairo_restore(cairo);
    draw_legend(cairo);
  }

 private:
  void set_directions() {
    const double lon = view_.from[0] * kDegree, lat = view_.from[1] * kDegree;
    toward_ = {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
    right_ = {-std::sin(lon), std::cos(lon), 0};
    up_ = cross(toward_, right_);
  }

  std::array<Point<3>, 3> corners(std::size_t t) const {
    const auto& [a, b, c] = body_.boundary[t];
    return {body_.at(a), body_.at(b), body_.at(c)};
  }

  double value(std::size_t t) const {
    const std::array<Point<3>, 3> x = corners(t);
    TriangleShape shape{};
    for (std::size_t k = 0; k < 3; ++k) {
      shape.edge[k] = length(difference(x[(k + 1) % 3], x[k]));
      shape.spacing[k] = body_.spacing[static_cast<std::size_t>(body_.boundary[t][k])];
    }
    return value_of(by_, shape);
  }

  Colour colour_of(std::size_t t) const {
    if (!scale_) return plain;
    return scale_->colours.colour(scale_->colours.class_of(value(t)));
  }

  void draw_ground(cairo_t* cairo) const {
    if (view_.as_map)
      cairo_rectangle(cairo, frame_.x(-180), frame_.y(90), frame_.pixels(360), frame_.pixels(180));
    else
      cairo_arc(cairo, frame_.x(0), frame_.y(0), frame_.pixels(view_.radius), 0,
                2 * std::numbers::pi);
    set_colour(cairo, bare);
    cairo_fill(cairo);
  }

  void clip(cairo_t* cairo) const {
    cairo_rectangle(cairo, frame_.x(-180), frame_.y(90), frame_.pixels(360), frame_.pixels(180));
    cairo_clip(cairo);
  }

  void draw_seen(cairo_t* cairo, std::size_t t) const {
    const std::array<Point<3>, 3> x = corners(t);
    const Point<3> normal = cross(difference(x[1], x[0]), difference(x[2], x[0]));
    const double outward = dot(normal, x[0]) < 0 ? -1 : 1;
    if (!(outward * dot(normal, toward_) > 0)) return;
    Shape shape;
    for (const Point<3>& corner : x) shape.push_back({dot(corner, right_), dot(corner, up_)});
    draw_shape(cairo, shape, colour_of(t));
  }

  // Returns longitudes and latitudes of the corners. A corner at a pole appears twice, with the
  // longitudes of its neighbours.
  Shape degrees_of_corners(std::size_t t) const {
    constexpr double at_pole = 90 - 1e-9;
    const std::array<Point<3>, 3> x = corners(t);
    Shape shape;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point<2> at = degrees_of(x[k]);
      if (std::fabs(at[1]) < at_pole) {
        shape.push_back(at);
      } else {
        shape.push_back({degrees_of(x[(k + 2) % 3])[0], at[1]});
        shape.push_back({degrees_of(x[(k + 1) % 3])[0], at[1]});
      }
    }
    return shape;
  }

  // Draws a triangle on the map. Each side takes the shorter way around. If the triangle contains a
  // pole, the longitudes add up to a full turn; then the strips between the sides and the pole are
  // drawn.
  void draw_on_map(cairo_t* cairo, std::size_t t) const {
    Shape shape = degrees_of_corners(t);
    shape.push_back(shape.front());
    for (std::size_t k = 1; k < shape.size(); ++k)
      shape[k][0] = shape[k - 1][0] + std::remainder(shape[k][0] - shape[k - 1][0], 360);
    const bool around_pole = std::fabs(shape.back()[0] - shape.front()[0]) > 180;
    const Colour colour = colour_of(t);
    if (!around_pole) {
      shape.pop_back();
      return draw_copies(cairo, shape, colour);
    }
    const double pole = shape.front()[1] > 0 ? 90 : -90;
    for (std::size_t k = 0; k + 1 < shape.size(); ++k) {
      const Point<2>&a = shape[k], &b = shape[k + 1];
      draw_copies(cairo, {a, b, {b[0], pole}, {a[0], pole}}, colour);
    }
  }

  // Draws a shape and, if it crosses an end of the map, its copy at the other end.
  void draw_copies(cairo_t* cairo, Shape shape, const Colour& colour) const {
    for (const double turn : {-360.0, 360.0, 360.0}) {
      for (Point<2>& corner : shape) corner[0] += turn;
      const auto beyond = [&](double side) {
        return std::ranges::all_of(shape, [&](const Point<2>& x) { return side * x[0] > 180; });
      };
      if (!beyond(-1) && !beyond(1)) draw_shape(cairo, shape, colour);
    }
  }

  void draw_shape(cairo_t* cairo, const Shape& shape, const Colour& colour) const {
    double longest = 0;
    for (std::size_t k = 0; k < shape.size(); ++k) {
      const Point<2>&at = shape[k], &next = shape[(k + 1) % shape.size()];
      if (k == 0)
        cairo_move_to(cairo, frame_.x(at[0]), frame_.y(at[1]));
      else
        cairo_line_to(cairo, frame_.x(at[0]), frame_.y(at[1]));
      longest = std::max(longest, std::hypot(next[0] - at[0], next[1] - at[1]));
    }
    cairo_close_path(cairo);
    set_colour(cairo, colour);
    cairo_fill_preserve(cairo);
    // The stroke also covers the seam that antialiased fills leave between two triangles.
    set_colour(cairo, edge_colour(colour, frame_.pixels(longest)));
    cairo_stroke(cairo);
  }

  // Draws the meridians and parallels at multiples of 30 degrees over the triangles.
  void draw_graticule(cairo_t* cairo) const {
    constexpr int between = 30;
    for (int lon = -180; lon < 180; lon += between) {
      Shape meridian;
      for (int lat = -90; lat <= 90; ++lat) meridian.push_back({1. * lon, 1. * lat});
      add_line(cairo, meridian);
    }
    for (int lat = -90 + between; lat < 90; lat += between) {
      Shape parallel;
      for (int lon = -180; lon <= 180; ++lon) parallel.push_back({1. * lon, 1. * lat});
      add_line(cairo, parallel);
    }
    constexpr double opacity = 0.55;
    set_colour(cairo, ink, opacity);
    cairo_set_line_width(cairo, 1.8 * frame_.line_width);
    cairo_stroke(cairo);
  }

  // Adds the visible parts of a line through points in degrees to the path.
  void add_line(cairo_t* cairo, const Shape& degrees) const {
    bool was_seen = false;
    for (const Point<2>& at : degrees) {
      const Point<3> x = shifted({}, view_.radius, direction_at(at));
      const bool seen = view_.as_map || dot(x, toward_) > 0;
      const Point<2> shown = view_.as_map ? at : Point<2>{dot(x, right_), dot(x, up_)};
      if (seen)
        (was_seen ? cairo_line_to : cairo_move_to)(cairo, frame_.x(shown[0]), frame_.y(shown[1]));
      was_seen = seen;
    }
  }

  void draw_legend(cairo_t* cairo) const {
    const double font_size = font_beside_colour_bar(frame_);
    const double base = begin_legend(cairo, frame_, font_size);
    if (scale_)
      draw_colour_bar(cairo, scale_->colours, title(),
                      {0.37 * frame_.width, base, 0.34 * frame_.width, font_size});
    draw_node_count(cairo, frame_, base, body_.size());
  }

  std::string title() const {
    return title_of(by_, "quality 2 r_in / R", "triangles", *scale_, body_.boundary.size());
  }

  const Body& body_;
  SphereView view_;
  ElementColour by_;
  Point<3> right_{}, up_{}, toward_{};  // directions in the picture; toward_: towards the viewer
  std::optional<ValueScale> scale_;
  PictureFrame frame_{};
};

}  // namespace

Drawing drawing_of(const Body& triangles, const SphereView& view, const PictureStyle& style) {
  const auto painter = std::make_shared<const SpherePainter>(triangles, view, style);
  const PictureFrame& frame = painter->frame();
  return {frame.width, frame.height, painter->description(),
          [painter](cairo_t* cairo) { painter->draw(cairo); }};
}

}  // namespace pnpbs::picture
