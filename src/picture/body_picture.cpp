// SPDX-License-Identifier: BSD-3-Clause
// Pictures of a body that is cut open, and of surface meshes. Faces are painted from the farthest
// to the nearest.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "base/space_vectors.hpp"
#include "picture/body.hpp"
#include "picture/cairo_surface.hpp"
#include "picture/cut_plane.hpp"
#include "picture/element_colour.hpp"
#include "picture/legend.hpp"
#include "picture/lettering.hpp"
#include "picture/palette.hpp"
#include "picture/picture.hpp"
#include "quality/volume/tetrahedron_quality.hpp"

namespace pnpbs::picture {
namespace {

class TetrahedronValues {
 public:
  // `body` must outlive this object. `by` must not be `none`.
  TetrahedronValues(const Body& body, ElementColour by);

  double at(std::size_t tetrahedron) const;
  const ColourScale& scale() const { return scale_.colours; }
  std::string title() const;  // quantity and range of the values in the body

 private:
  const Body& body_;
  ElementColour by_;
  ValueScale scale_;
};

using Spacing = std::array<double, 4>;

double edge_over_spacing(const TetrahedronCorners& corners, const Spacing& d) {
  double sum = 0;
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = 0; b < a; ++b)
      sum += distance<3>(corners[a], corners[b]) / (0.5 * (d[a] + d[b]));
  return sum / 6;
}

TetrahedronValues::TetrahedronValues(const Body& body, ElementColour by) : body_(body), by_(by) {
  scale_ = scale_for(by, {body.tetrahedra.size(), [this](std::size_t t) { return at(t); }});
}

double TetrahedronValues::at(std::size_t tetrahedron) const {
  const TetrahedronCorners corners = body_.corners(tetrahedron);
  Spacing d;
  for (std::size_t k = 0; k < 4; ++k)
    d[k] = body_.spacing[static_cast<std::size_t>(body_.tetrahedra[tetrahedron][k])];
  switch (by_) {
    case ElementColour::quality:
      return std::clamp(tetrahedron_quality(corners), 0.0, 1.0);
    case ElementColour::edge:
      return edge_over_spacing(corners, d);
    case ElementColour::spacing:
      return (d[0] + d[1] + d[2] + d[3]) / 4;
    case ElementColour::none:
      break;
  }
  return 0;
}

std::string TetrahedronValues::title() const {
  return title_of(by_, "quality 3 r_in / R", "tetrahedra", scale_, body_.tetrahedra.size());
}

// A face that the picture shows.
struct VisibleFace {
  std::array<std::int64_t, 3> corners;  // in no particular order
  // The tetrahedron behind the cut plane that has the face; 0 for surface meshes.
  std::size_t tetrahedron;
  bool cut;  // true if the tetrahedron on the other side is removed, false on the boundary
};

using Corners = std::array<std::int64_t, 3>;
using Marks = std::vector<bool>;  // by node or tetrahedron

// Returns whether the centroid of the tetrahedron lies behind the plane.
bool is_kept(const TetrahedronCorners& x, const CutPlane& plane) {
  double sum = 0;
  for (const Point<3>& corner : x) sum += plane.height(corner);
  return sum <= 0;
}

// Returns the corners in ascending order, so that both tetrahedra at a face have the same key.
Corners face_of(const std::array<std::int64_t, 4>& tetrahedron, std::size_t opposite) {
  Corners face{tetrahedron[(opposite + 1) % 4], tetrahedron[(opposite + 2) % 4],
               tetrahedron[(opposite + 3) % 4]};
  std::ranges::sort(face);
  return face;
}

bool all_marked(const Marks& marks, const Corners& face) {
  return std::ranges::all_of(
      face, [&](std::int64_t node) { return marks[static_cast<std::size_t>(node)]; });
}

void mark(Marks& marks, const auto& corners) {
  for (const std::int64_t node : corners) marks[static_cast<std::size_t>(node)] = true;
}

// The faces that can be visible. Sorting all faces would take far more time and memory, so only
// faces are sorted whose corners all lie on the boundary or in removed tetrahedra.
class Shell {
 public:
  Shell(const Body& body, const CutPlane& plane)
      : body_(body), kept_(body.tetrahedra.size()), outside_(body.size()), inside_(body.size()) {
    for (std::size_t t = 0; t < kept_.size(); ++t) {
      kept_[t] = is_kept(body.corners(t), plane);
      mark(kept_[t] ? inside_ : outside_, body.tetrahedra[t]);
    }
    Marks beside = outside_;
    for (const Corners& triangle : body.boundary) mark(beside, triangle);
    for (std::size_t t = 0; t < kept_.size(); ++t)
      if (kept_[t]) for_faces(t, beside, [&](const Corners& face) { faces_.push_back({face, t}); });
    std::ranges::sort(faces_, {}, &Face::corners);
  }

  std::vector<VisibleFace> visible() const {
    std::vector<VisibleFace> found;
    for (Corners triangle : body_.boundary) {
      std::ranges::sort(triangle);
      add_if_kept(triangle, false, found);
    }
    for (std::size_t t = 0; t < kept_.size(); ++t)
      if (!kept_[t])
        for_faces(t, inside_, [&](const Corners& face) { add_if_kept(face, true, found); });
    return found;
  }

 private:
  struct Face {
    Corners corners;
    std::size_t tetrahedron;
  };

  template <class Work>
  void for_faces(std::size_t t, const Marks& marks, const Work& work) const {
    for (std::size_t opposite = 0; opposite < 4; ++opposite) {
      const Corners face = face_of(body_.tetrahedra[t], opposite);
      if (all_marked(marks, face)) work(face);
    }
  }

  void add_if_kept(const Corners& face, bool cut, std::vector<VisibleFace>& found) const {
    const auto place = std::ranges::lower_bound(faces_, face, {}, &Face::corners);
    if (place != faces_.end() && place->corners == face)
      found.push_back({face, place->tetrahedron, cut});
  }

  const Body& body_;
  Marks kept_;              // by tetrahedron
  Marks outside_, inside_;  // nodes of removed tetrahedra, and of kept ones
  std::vector<Face> faces_;
};

// Returns the faces that the kept tetrahedra have in common with removed ones (the cut) or with the
// boundary. A tetrahedron is kept if its centroid lies behind the plane. Returns all triangles of a
// surface mesh, which is not cut.
std::vector<VisibleFace> visible_faces(const Body& body, const CutPlane& plane) {
  if (body.is_surface_mesh()) {
    std::vector<VisibleFace> all;
    for (const Corners& triangle : body.boundary) all.push_back({triangle, 0, false});
    return all;
  }
  return Shell(body, plane).visible();
}

// Orthographic view of a body, from above and to the right of the normal of the cut plane.
class BodyView {
 public:
  explicit BodyView(const CutPlane& plane);

  Point<2> project(const Point<3>& x) const { return {dot(x, right_), dot(x, up_)}; }
  double nearness(const Point<3>& x) const { return dot(x, toward_); }
  bool shows(const Point<3>& normal) const { return dot(normal, toward_) > 0; }

  // Returns the brightness of a surface with this unit normal, from 0 to 1.
  double light(const Point<3>& normal) const;
  double light_on_plane() const { return on_plane_; }

 private:
  Point<3> right_, up_, toward_;  // directions in the picture; toward_: towards the viewer
  double on_plane_ = 1;
};

constexpr double degree = std::numbers::pi / 180;
constexpr double turned = 26 * degree;  // rotation of the view to the right. [rad]
// Elevation of the view. [rad]
constexpr double raised = 22 * degree;
constexpr Point<3> lamp{-0.46, 0.56, 0.69};  // direction to the light: right, up, toward the viewer
// |z| of the unit normal above which a plane is a floor and not a wall
constexpr double flat_lying = 0.8;

// Returns v scaled to length 1, or 0 for the vector 0.
Point<3> unit_vector(const Point<3>& v) {
  const double length = std::sqrt(dot(v, v));
  return length > 0 ? Point<3>{v[0] / length, v[1] / length, v[2] / length} : Point<3>{};
}

BodyView::BodyView(const CutPlane& plane) {
  const Point<3> normal = unit_vector(plane.normal);
  const bool floor = std::fabs(normal[2]) > flat_lying;
  // On a wall, z points up. On a floor, y does, and the viewer is on the side of -y.
  const Point<3> right = unit_vector(cross(floor ? Point<3>{0, 1, 0} : Point<3>{0, 0, 1}, normal));
  const Point<3> up = cross(normal, right);
  const double rise = floor ? -raised : raised;
  for (std::size_t k = 0; k < 3; ++k)
    toward_[k] = std::cos(rise) * (std::cos(turned) * normal[k] + std::sin(turned) * right[k]) +
                 std::sin(rise) * up[k];
  right_ = unit_vector(cross(up, toward_));
  up_ = cross(toward_, right_);
  on_plane_ = light(normal);
}

double BodyView::light(const Point<3>& normal) const {
  const Point<3> seen{dot(normal, right_), dot(normal, up_), dot(normal, toward_)};
  return 0.5 + 0.5 * dot(seen, lamp);
}

constexpr PictureSize body_picture_size{18, 1400, 2400};

constexpr Colour skin = colour(0xb9cadb);  // colour of the boundary
// Colour of cut tetrahedra if they are not coloured by a value.
constexpr Colour flesh = colour(0xf0dcae);

// Loss of brightness where no light falls. [1]
constexpr double shade_of_skin = 0.6;
constexpr double shade_of_cut = 0.4;

// Circumcentres whose depths differ by less than this are treated as equal, because they may differ
// by rounding only. [depth of the body]
constexpr double one_sphere = 1e-9;

// A triangle of the picture with its colour and the keys of the painting order.
struct PaintedFace {
  double x[3], y[3];
  Colour colour;
  std::size_t tetrahedron;
  double nearness;  // of the circumcentre of the tetrahedron; 0 for surface meshes
  double depth;     // nearness of the face's centroid
};

Colour shaded(const Colour& colour, double shade, double light) {
  const double bright = 1 - shade * (1 - light);
  return {colour.red * bright, colour.green * bright, colour.blue * bright};
}

class BodyPainter {
 public:
  BodyPainter(const Body& body, const CutPlane& plane, const PictureStyle& style)
      : body_(body), plane_(plane), view_(plane) {
    if (style.colour != ElementColour::none && !body.is_surface_mesh())
      values_.emplace(body, style.colour);
    for (const VisibleFace& face : visible_faces(body, plane)) add(face);
    sort();
    std::vector<double> shown;
    for (const PaintedFace& face : faces_)
      for (std::size_t k = 0; k < 3; ++k) shown.insert(shown.end(), {face.x[k], face.y[k]});
    frame_ = frame_around(bounds_of({shown}), body.spacing, body_picture_size, style.unit);
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

// Returns the normal turned to the outside of the tetrahedron `of`. `at` is a corner of the face.
Point<3> turned_outward(const Point<3>& normal, const Point<3>& at, const TetrahedronCorners& of) {
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
  if (body_.is_surface_mesh()) {
    // Both sides of an open surface are visible.
    if (!view_.shows(normal)) normal = opposite(normal);
  } else {
    const TetrahedronCorners corners = body_.corners(face.tetrahedron);
    normal = turned_outward(normal, a, corners);
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
  // Scale colours must match the legend where the cut is flat, so light is relative to the plane.
  const double light = view_.light(normal);
  painted.colour = face.cut
                       ? shaded(colour, shade_of_cut, std::min(1.0, light / view_.light_on_plane()))
                       : shaded(colour, shade_of_skin, light);
  faces_.push_back(painted);
}

void BodyPainter::round_nearness() {
  double low = 0, high = 0;  // relative to the first node
  for (const Point<3>& x : body_.positions) {
    const double nearness = view_.nearness(difference(x, body_.positions.front()));
    low = std::min(low, nearness);
    high = std::max(high, nearness);
  }
  const double grain = one_sphere * (high - low);
  if (!(grain > 0)) return;
  for (PaintedFace& face : faces_) face.nearness = std::round(face.nearness / grain);
}

// Sorts faces from far to near. Of two Delaunay tetrahedra with a common face, the nearer one has
// the nearer circumcentre, so this order is right along every line of sight. If circumspheres
// coincide, the centroids of the faces decide.
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
  // The stroke also covers the seam that antialiased fills leave between two faces.
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

// Draws arrows in the directions of x, y and z.
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
    if (std::hypot(right, up) < 0.2) continue;  // no label, since the axis points at the viewer
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
  if (!body_.is_surface_mesh())
    draw_text(cairo, frame_.width - frame_.margin, base - 1.3 * font_size, "cut at " + plane_.name,
              1);
}

std::string BodyPainter::description() const {
  if (body_.is_surface_mesh()) return "Surfaces";
  const std::string cut = "Body cut at " + plane_.name;
  if (!values_) return cut;
  return cut + ", tetrahedra by " + words_of(values_->scale(), values_->title());
}

}  // namespace

Drawing drawing_of(const Body& body, const CutPlane& plane, const PictureStyle& style) {
  const auto painter = std::make_shared<const BodyPainter>(body, plane, style);
  const PictureFrame& frame = painter->frame();
  return {frame.width, frame.height, painter->description(),
          [painter](cairo_t* cairo) { painter->draw(cairo); }};
}

}  // namespace pnpbs::picture
