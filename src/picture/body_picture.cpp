// SPDX-License-Identifier: BSD-3-Clause
// A body cut open, or surfaces alone: faces painted from the farthest to the nearest.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <tuple>

#include "picture/body_view.hpp"
#include "picture/cairo_surface.hpp"
#include "picture/colour_bar.hpp"
#include "picture/face_edge.hpp"
#include "picture/legend.hpp"
#include "picture/lettering.hpp"
#include "picture/picture.hpp"
#include "picture/tetrahedron_values.hpp"
#include "picture/visible_faces.hpp"

namespace pnpbs::picture {
namespace {

constexpr PictureSize body_picture_size{18, 1400, 2400};

constexpr Colour skin = colour(0xb9cadb);   // the boundary
constexpr Colour flesh = colour(0xf0dcae);  // tetrahedra that have no colour of their own

// How much darker it is where no light falls.
constexpr double shade_of_skin = 0.6;
constexpr double shade_of_cut = 0.4;

// Circumcentres that are nearer to each other along the line of sight, as a part of the body's
// depth, are one but for rounding.
constexpr double one_sphere = 1e-9;

struct PaintedFace {
  double x[3], y[3];
  Colour colour;
  std::size_t tetrahedron;
  double nearness;  // of the tetrahedron
  double depth;     // of the face
};

Colour shaded(const Colour& colour, double shade, double light) {
  const double bright = 1 - shade * (1 - light);
  return {colour.red * bright, colour.green * bright, colour.blue * bright};
}

class BodyPainter {
 public:
  BodyPainter(const Body& body, const CutPlane& plane, ElementColour colour)
      : body_(body), plane_(plane), view_(plane) {
    if (colour != ElementColour::none && !body.surfaces_alone()) values_.emplace(body, colour);
    for (const VisibleFace& face : visible_faces(body, plane)) add(face);
    sort();
    std::vector<double> shown;
    for (const PaintedFace& face : faces_)
      for (std::size_t k = 0; k < 3; ++k) shown.insert(shown.end(), {face.x[k], face.y[k]});
    frame_ = frame_around(bounds_of({shown}), body.spacing, body_picture_size);
  }

  const PictureFrame& frame() const { return frame_; }
  std::string description() const;
  void draw(cairo_t* cairo) const;

 private:
  void add(const VisibleFace& face);
  void sort();
  void round_nearness();
  void paint(cairo_t* cairo, const PaintedFace& face) const;
  void paint_faces(cairo_t* cairo) const;
  void draw_axes(cairo_t* cairo, double x, double y, double font_size) const;
  void legend(cairo_t* cairo) const;

  const Body& body_;
  CutPlane plane_;
  BodyView view_;
  std::optional<TetrahedronValues> values_;
  std::vector<PaintedFace> faces_;
  PictureFrame frame_{};
};

Point<3> opposite(const Point<3>& x) { return {-x[0], -x[1], -x[2]}; }

// The normal of a face at one of its corners, away from the inside of its tetrahedron.
Point<3> turned_away(const Point<3>& normal, const Point<3>& at, const TetrahedronCorners& of) {
  double inward = 0;
  for (const Point<3>& corner : of) inward += dot(normal, difference(corner, at));
  return inward > 0 ? opposite(normal) : normal;
}

void BodyPainter::add(const VisibleFace& face) {
  const Point<3>&a = body_.at(face.corners[0]), &b = body_.at(face.corners[1]),
        &c = body_.at(face.corners[2]);
  PaintedFace painted{};
  painted.tetrahedron = face.tetrahedron;
  Point<3> normal = unit_vector(cross(difference(b, a), difference(c, a)));
  if (body_.surfaces_alone()) {
    if (!view_.shows(normal)) normal = opposite(normal);  // of an open one both sides are seen
  } else {
    const TetrahedronCorners corners = body_.corners(face.tetrahedron);
    normal = turned_away(normal, a, corners);
    if (!view_.shows(normal)) return;
    painted.nearness = view_.nearness(circumsphere(corners).centre);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const Point<3>& corner = body_.at(face.corners[k]);
    const Point<2> at = view_.project(corner);
    painted.x[k] = at[0];
    painted.y[k] = at[1];
    painted.depth += view_.nearness(corner) / 3;
  }
  Colour colour = face.cut ? flesh : skin;
  if (face.cut && values_) {
    const ColourScale& scale = values_->scale();
    colour = scale.colour(scale.class_of(values_->at(face.tetrahedron)));
  }
  // Colours that mean numbers are themselves where the cut is even.
  const double light = view_.light(normal);
  painted.colour = face.cut
                       ? shaded(colour, shade_of_cut, std::min(1.0, light / view_.light_on_plane()))
                       : shaded(colour, shade_of_skin, light);
  faces_.push_back(painted);
}

void BodyPainter::round_nearness() {
  double low = 0, high = 0;  // from the first node
  for (const Point<3>& x : body_.positions) {
    const double nearness = view_.nearness(difference(x, body_.positions.front()));
    low = std::min(low, nearness);
    high = std::max(high, nearness);
  }
  const double grain = one_sphere * (high - low);
  if (!(grain > 0)) return;
  for (PaintedFace& face : faces_) face.nearness = std::round(face.nearness / grain);
}

// Of two Delaunay tetrahedra with a common face the one before it has its circumcentre before the
// other's: along every line of sight they follow each other in this order. Those on one sphere are
// told apart by the face.
void BodyPainter::sort() {
  round_nearness();
  std::ranges::sort(faces_, [](const PaintedFace& a, const PaintedFace& b) {
    return std::tie(a.nearness, a.depth, a.tetrahedron) <
           std::tie(b.nearness, b.depth, b.tetrahedron);
  });
}

void BodyPainter::paint(cairo_t* cairo, const PaintedFace& face) const {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = frame_.x(face.x[k]), y = frame_.y(face.y[k]);
    if (k == 0)
      cairo_move_to(cairo, x, y);
    else
      cairo_line_to(cairo, x, y);
    const std::size_t next = (k + 1) % 3;
    longest = std::max(longest, std::hypot(face.x[next] - face.x[k], face.y[next] - face.y[k]));
  }
  cairo_close_path(cairo);
  set_colour(cairo, face.colour);
  cairo_fill_preserve(cairo);
  // The edge also covers the seam that softened fills leave between two faces.
  set_colour(cairo, edge_colour(face.colour, frame_.pixels(longest)));
  cairo_stroke(cairo);
}

void BodyPainter::paint_faces(cairo_t* cairo) const {
  cairo_set_line_width(cairo, 0.6 * frame_.line_width);
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  for (const PaintedFace& face : faces_) paint(cairo, face);
}

void BodyPainter::draw(cairo_t* cairo) const {
  paint_faces(cairo);
  legend(cairo);
}

// Where x, y and z point to.
void BodyPainter::draw_axes(cairo_t* cairo, double x, double y, double font_size) const {
  const double length = 1.25 * font_size;
  for (std::size_t k = 0; k < 3; ++k) {
    Point<3> axis{};
    axis[k] = 1;
    const auto [right, up] = view_.project(axis);
    cairo_move_to(cairo, x, y);
    cairo_line_to(cairo, x + length * right, y - length * up);
    set_colour(cairo, ink);
    cairo_set_line_width(cairo, 1.2 * frame_.line_width);
    cairo_stroke(cairo);
    if (std::hypot(right, up) < 0.2) continue;  // it points at us
    const double beyond = length + 0.45 * font_size / std::hypot(right, up);
    draw_text(cairo, x + beyond * right, y - beyond * up + 0.28 * font_size,
              std::string(1, "xyz"[k]), 0.5);
  }
}

void BodyPainter::legend(cairo_t* cairo) const {
  const double font_size = font_beside_colour_bar(frame_);
  const double base = begin_legend(cairo, frame_, font_size);
  draw_axes(cairo, 0.285 * frame_.width, base - 0.8 * font_size, font_size);
  if (values_)
    draw_colour_bar(cairo, values_->scale(), values_->title(),
                    {0.37 * frame_.width, base, 0.34 * frame_.width, font_size});
  draw_node_count(cairo, frame_, base, body_.size());
  if (!body_.surfaces_alone())
    draw_text(cairo, frame_.width - frame_.margin, base - 1.3 * font_size, "cut at " + plane_.name,
              1);
}

std::string BodyPainter::description() const {
  if (body_.surfaces_alone()) return "Surfaces";
  const std::string cut = "Body cut at " + plane_.name;
  if (!values_) return cut;
  return cut + ", tetrahedra by " + words_of(values_->scale(), values_->title());
}

}  // namespace

Drawing drawing_of(const Body& body, const CutPlane& plane, ElementColour colour) {
  const auto painter = std::make_shared<const BodyPainter>(body, plane, colour);
  const PictureFrame& frame = painter->frame();
  return {frame.width, frame.height, painter->description(),
          [painter](cairo_t* cairo) { painter->draw(cairo); }};
}

}  // namespace pnpbs::picture
