// SPDX-License-Identifier: BSD-3-Clause
// Picture of a plane node set: discs sized by d over the curves of the domain, and a legend with a
// scale bar and the meaning of the colours.
#include "picture/picture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "picture/legend.hpp"
#include "picture/lettering.hpp"
#include "picture/palette.hpp"
#include "picture/triangle_fill.hpp"

namespace pnpbs::picture {
namespace {

// Number of size classes; discs of a class share colour and size.
constexpr int spacing_classes = 48;
// Number of discs per path. Cairo uses about 2 kB of memory for each.
constexpr std::size_t discs_at_once = 4096;
// Disc diameters of inner nodes: normally, and if there are few pixels per spacing. [d]
constexpr double disc_over_spacing = 0.6;
constexpr double dense_disc = 0.85;
// Disc diameter of boundary nodes. [shortest edge, at most d]
constexpr double boundary_disc = 0.45;
// Disc diameter at the centre of a bubble. [d]
constexpr double disc_in_bubble = 0.22;
constexpr double min_disc = 1.1;        // smallest disc diameter. [pixels]
constexpr double edge_on_colour = 0.3;  // opacity of triangle edges over coloured triangles
constexpr PictureSize picture_size{14, 1000, 2400};

// ------------------------------------------------------------------------ spacing -----------

// Classes of spacing with a constant ratio from one to the next.
class SpacingScale {
 public:
  explicit SpacingScale(const std::vector<double>& spacing) {
    if (spacing.empty()) return;
    const auto [min, max] = std::ranges::minmax_element(spacing);
    min_ = *min;
    max_ = *max;
  }
  double min() const { return min_; }
  double max() const { return max_; }
  bool uniform() const { return max_ < 1.02 * min_; }
  double fraction(double d) const { return uniform() ? 0.4 : std::log(d / min_) / span(); }
  double at(double fraction) const { return min_ * std::exp(fraction * span()); }
  int class_of(double d) const {
    if (uniform()) return 0;
    return std::clamp(static_cast<int>(fraction(d) * spacing_classes), 0, spacing_classes - 1);
  }
  double class_spacing(int index) const { return at((index + 0.5) / spacing_classes); }

 private:
  double span() const { return std::log(max_ / min_); }
  double min_ = 1, max_ = 1;
};

// ------------------------------------------------------------------------ nodes -------------

// Returns for each node the length of the shortest triangle edge at it, at most d, which limits the
// size of its disc.
std::vector<double> room_at(const NodeSet& nodes) {
  std::vector<double> room = nodes.spacing;
  for (const auto& corners : nodes.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = static_cast<std::size_t>(corners[k]);
      const auto b = static_cast<std::size_t>(corners[(k + 1) % 3]);
      const double length =
          std::hypot(nodes.xy[2 * b] - nodes.xy[2 * a], nodes.xy[2 * b + 1] - nodes.xy[2 * a + 1]);
      room[a] = std::min(room[a], length);
      room[b] = std::min(room[b], length);
    }
  }
  return room;
}

// The boundary nodes, or the inner nodes, grouped by classes of their size.
class NodeClasses {
 public:
  NodeClasses(const NodeSet& nodes, const std::vector<double>& size, bool boundary)
      : scale_(size), members_(spacing_classes) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if ((nodes.tags[i] != 0) == boundary) {
        members_[static_cast<std::size_t>(scale_.class_of(size[i]))].push_back(i);
      }
    }
  }
  double size(int index) const { return scale_.class_spacing(index); }
  const std::vector<std::size_t>& members(int index) const {
    return members_[static_cast<std::size_t>(index)];
  }

 private:
  SpacingScale scale_;
  std::vector<std::vector<std::size_t>> members_;
};

class Painter {
 public:
  Painter(cairo_t* cairo, const NodeSet& nodes, const PictureFrame& frame)
      : cairo_(cairo),
        nodes_(nodes),
        frame_(frame),
        scale_(nodes.spacing),
        inner_(nodes, nodes.spacing, false),
        boundary_(nodes, room_at(nodes), true) {
    cairo_set_line_cap(cairo_, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
  }

  void triangles(const Colour& colour, double opacity);
  void bubbles();
  void outline();
  void outline(bool open, const Colour& colour, double line_width);
  void discs(double inner_over_spacing, double boundary_over_spacing);
  void legend();
  void legend(const TriangleValues& values);

 private:
  double x(std::size_t node) const { return frame_.x(nodes_.xy[2 * node]); }
  double y(std::size_t node) const { return frame_.y(nodes_.xy[2 * node + 1]); }
  Colour colour_of(double spacing) const { return spacing_colour(scale_.fraction(spacing)); }
  void bubble(std::size_t node);
  void discs_of(const std::vector<std::size_t>& members, const Colour& colour, double diameter);
  void colour_bar(double left, double base, double width);
  double key(double left, double base, const std::string& meaning, const Colour& colour);
  void dot(double x, double y);

  cairo_t* cairo_;
  const NodeSet& nodes_;
  const PictureFrame& frame_;
  SpacingScale scale_;
  NodeClasses inner_, boundary_;
};

// Adds a disc to the path: a line of length 0 with round ends, which is the shortest form in a
// file.
void Painter::dot(double x, double y) {
  cairo_move_to(cairo_, x, y);
  cairo_close_path(cairo_);
}

void Painter::triangles(const Colour& colour, double opacity) {
  if (nodes_.triangles.empty()) return;
  if (frame_.pixels(frame_.typical_spacing) < edges_from_spacing) return;
  for (const auto& corners : nodes_.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = static_cast<std::size_t>(corners[k]);
      const auto b = static_cast<std::size_t>(corners[(k + 1) % 3]);
      if (a > b) continue;  // inner edges appear in both directions; the outline has the others
      cairo_move_to(cairo_, x(a), y(a));
      cairo_line_to(cairo_, x(b), y(b));
    }
  }
  set_colour(cairo_, colour, opacity);
  cairo_set_line_width(cairo_, frame_.line_width * 0.6);
  cairo_stroke(cairo_);
}

void Painter::bubble(std::size_t node) {
  cairo_new_sub_path(cairo_);
  cairo_arc(cairo_, x(node), y(node), 0.5 * frame_.pixels(nodes_.spacing[node]), 0,
            2 * std::numbers::pi);
}

void Painter::bubbles() {
  for (const NodeClasses* classes : {&boundary_, &inner_}) {
    for (int c = 0; c < spacing_classes; ++c) {
      if (classes->members(c).empty()) continue;
      for (const std::size_t node : classes->members(c)) bubble(node);
      const Colour colour = classes == &inner_ ? colour_of(inner_.size(c)) : boundary_node;
      set_colour(cairo_, colour, 0.10);
      cairo_fill_preserve(cairo_);
      set_colour(cairo_, colour, 0.55);
      cairo_set_line_width(cairo_, 0.6 * frame_.line_width);
      cairo_stroke(cairo_);
    }
  }
}

void Painter::outline() {
  outline(false, ink, frame_.line_width);
  outline(true, open_boundary, 2.5 * frame_.line_width);
}

// Draws the open boundary or everything else.
void Painter::outline(bool open, const Colour& colour, double line_width) {
  for (std::size_t s = 0; s < nodes_.open.size(); ++s) {
    if (nodes_.open[s] != open) continue;
    const double* ends = &nodes_.outline[4 * s];
    cairo_move_to(cairo_, frame_.x(ends[0]), frame_.y(ends[1]));
    cairo_line_to(cairo_, frame_.x(ends[2]), frame_.y(ends[3]));
  }
  set_colour(cairo_, colour);
  cairo_set_line_width(cairo_, line_width);
  cairo_stroke(cairo_);
}

void Painter::discs(double inner_over_spacing, double boundary_over_spacing) {
  // Draw large discs first, so that small ones stay visible.
  for (int c = spacing_classes - 1; c >= 0; --c) {
    discs_of(inner_.members(c), colour_of(inner_.size(c)),
             inner_over_spacing * frame_.pixels(inner_.size(c)));
  }
  for (int c = spacing_classes - 1; c >= 0; --c) {
    discs_of(boundary_.members(c), boundary_node,
             boundary_over_spacing * frame_.pixels(boundary_.size(c)));
  }
}

void Painter::discs_of(const std::vector<std::size_t>& members, const Colour& colour,
                       double diameter) {
  if (members.empty()) return;
  set_colour(cairo_, colour);
  cairo_set_line_width(cairo_, std::max(min_disc, diameter));
  for (std::size_t k = 0; k < members.size(); ++k) {
    dot(x(members[k]), y(members[k]));
    if ((k + 1) % discs_at_once == 0) cairo_stroke(cairo_);
  }
  cairo_stroke(cairo_);
}

// ------------------------------------------------------------------------ legend ------------

void Painter::colour_bar(double left, double base, double width) {
  const double height = 0.55 * frame_.font_size;
  cairo_pattern_t* gradient = cairo_pattern_create_linear(left, 0, left + width, 0);
  for (int step = 0; step <= 16; ++step) {
    const Colour c = spacing_colour(step / 16.0);
    cairo_pattern_add_color_stop_rgb(gradient, step / 16.0, c.red, c.green, c.blue);
  }
  cairo_rectangle(cairo_, left, base - height, width, height);
  cairo_set_source(cairo_, gradient);
  cairo_fill(cairo_);
  cairo_pattern_destroy(gradient);
  const double above = base - height - 0.45 * frame_.font_size;
  draw_text(cairo_, left, above, "d = " + short_number(scale_.min()), 0);
  draw_text(cairo_, left + 0.5 * width, above, short_number(scale_.at(0.5)), 0.5);
  draw_text(cairo_, left + width, above, short_number(scale_.max()), 1);
}

// Draws a disc with its meaning. Returns the x at which the text ends. [pixels]
double Painter::key(double left, double base, const std::string& meaning, const Colour& colour) {
  const double size = 0.6 * frame_.font_size;
  dot(left + 0.5 * size, base - 0.55 * size);
  set_colour(cairo_, colour);
  cairo_set_line_width(cairo_, size);
  cairo_stroke(cairo_);
  return draw_text(cairo_, left + 1.5 * size, base, meaning, 0);
}

void Painter::legend(const TriangleValues& values) {
  const double font_size = font_beside_colour_bar(frame_);
  const double base = begin_legend(cairo_, frame_, font_size);
  draw_colour_bar(cairo_, values.scale(), values.title(),
                  {0.32 * frame_.width, base, 0.36 * frame_.width, font_size});
  draw_node_count(cairo_, frame_, base, nodes_.size());
}

void Painter::legend() {
  const double base = begin_legend(cairo_, frame_, frame_.font_size);
  const double middle = 0.3 * frame_.width;
  double end = middle + 0.28 * frame_.width;
  if (scale_.uniform()) {
    end =
        draw_text(cairo_, middle, base, "d = " + short_number(scale_.min()), 0) + frame_.font_size;
    end = key(end, base, "inner", colour_of(scale_.min()));
  } else {
    colour_bar(middle, base, end - middle);
  }
  end = key(end + frame_.font_size, base, "boundary", boundary_node);
  if (std::ranges::find(nodes_.open, true) != nodes_.open.end())
    key(end + frame_.font_size, base, "open", open_boundary);
  draw_node_count(cairo_, frame_, base, nodes_.size());
}

// ------------------------------------------------------------------------ the whole ---------

// Returns the disc diameter. Small discs look pale, so it is larger if there are few pixels per
// spacing. [d]
double disc_size(const PictureFrame& frame) {
  const double pixels = frame.pixels(frame.typical_spacing);
  return std::lerp(dense_disc, disc_over_spacing, std::clamp((pixels - 4) / 8, 0.0, 1.0));
}

void draw(cairo_t* cairo, const NodeSet& nodes, const PictureFrame& frame,
          const PictureStyle& style) {
  Painter painter(cairo, nodes, frame);
  if (style.colour != ElementColour::none) {
    const TriangleValues values(nodes, style.colour);
    fill_triangles(cairo, frame, values);
    painter.triangles(ink, edge_on_colour);
    painter.outline();
    painter.legend(values);
    return;
  }
  if (style.bubbles) {
    painter.bubbles();
    painter.outline();
    painter.discs(disc_in_bubble, disc_in_bubble);
  } else {
    painter.triangles(triangle_edge, 1);
    painter.outline();
    painter.discs(disc_size(frame), boundary_disc);
  }
  painter.legend();
}

std::string description_of(const NodeSet& nodes, const PictureStyle& style) {
  if (style.colour == ElementColour::none) return "";
  const TriangleValues values(nodes, style.colour);
  return "Triangles by " + words_of(values.scale(), values.title());
}

}  // namespace

Drawing drawing_of(const NodeSet& nodes, const PictureStyle& style) {
  const PictureFrame frame =
      frame_around(bounds_of({nodes.outline, nodes.xy}), nodes.spacing, picture_size, style.unit);
  return {frame.width, frame.height, description_of(nodes, style),
          [&nodes, frame, style](cairo_t* cairo) { draw(cairo, nodes, frame, style); }};
}

}  // namespace pnpbs::picture
