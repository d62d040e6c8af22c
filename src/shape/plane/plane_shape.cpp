// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>

#include "domain/plane/sampling.hpp"
#include "shape/shape.hpp"

namespace pnpbs {

namespace {

constexpr double kFeatureTurn = kFeatureAngle * std::numbers::pi / 180;
// Largest distance of a chord from its curve [size of the domain]
constexpr double kMaxCurveSag = 1e-7;

// Returns the angle between the two segments. [radians]
double turn_at(const Point<2>& before, const Point<2>& x, const Point<2>& after) {
  const double ux = x[0] - before[0], uy = x[1] - before[1], vx = after[0] - x[0],
               vy = after[1] - x[1];
  return std::atan2(std::fabs(ux * vy - uy * vx), ux * vx + uy * vy);
}

// Returns the radius of the circle through three points, from the outer ones and the turn at the
// middle one, by the law of sines.
double radius_through(const Point<2>& before, const Point<2>& after, double turn) {
  return turn > 0 ? distance<2>(before, after) / (2 * std::sin(turn)) : ShapePiece<2>::kNone;
}

class PlaneShape {
 public:
  explicit PlaneShape(const PlaneDomain& domain) : domain_(domain) {
    const Box<2>& box = domain.bounds();
    size_ = distance<2>(box.low, box.high);
  }

  Shape<2> run() {
    add_vertices();
    for (std::size_t c = 0; c < domain_.curves().size(); ++c) add_curve(c);
    add_points();
    return std::move(shape_);
  }

 private:
  struct Vertex {
    Point<2> x;
    bool on_smooth = false;  // inside a smooth curve
    int degree = 0;
    std::array<std::int32_t, 2> neighbours{};
  };

  // Corners keep their numbers; the other vertices of the curves follow.
  void add_vertices() {
    for (const Corner& corner : domain_.corners()) vertices_.push_back({corner.position});
    for (const BoundaryCurve& curve : domain_.curves()) {
      std::vector<std::int32_t>& way = ways_.emplace_back();
      for (std::size_t p = 0; p < curve.points.size(); ++p) {
        const bool begins = p == 0, ends = p + 1 == curve.points.size();
        way.push_back(static_cast<std::int32_t>(begins ? curve.corner_begin
                                                : ends ? curve.corner_end
                                                       : std::ssize(vertices_)));
        if (!begins && !ends) vertices_.push_back({curve.points[p], bool(curve.evaluate)});
      }
      for (std::size_t p = 0; p + 1 < way.size(); ++p) {
        add_neighbour(way[p], way[p + 1]);
        add_neighbour(way[p + 1], way[p]);
      }
    }
  }

  void add_neighbour(std::int32_t v, std::int32_t other) {
    Vertex& vertex = vertices_[static_cast<std::size_t>(v)];
    if (vertex.degree < 2) vertex.neighbours[static_cast<std::size_t>(vertex.degree)] = other;
    ++vertex.degree;
  }

  double radius_at(std::int32_t v) const {
    const Vertex& vertex = vertices_[static_cast<std::size_t>(v)];
    if (vertex.degree != 2) return ShapePiece<2>::kNone;
    const Point<2>&before = vertices_[static_cast<std::size_t>(vertex.neighbours[0])].x,
          &after = vertices_[static_cast<std::size_t>(vertex.neighbours[1])].x;
    const double turn = turn_at(before, vertex.x, after);
    // Between samples, smooth curves turn by more than kSampleTurn only at kinks.
    const bool kink = vertex.on_smooth ? turn > 1.5 * kSampleTurn : turn >= kFeatureTurn;
    return kink ? ShapePiece<2>::kNone : radius_through(before, after, turn);
  }

  void add_curve(std::size_t c) {
    const BoundaryCurve& curve = domain_.curves()[c];
    const std::vector<std::int32_t>& way = ways_[c];
    std::vector<double> radius;
    for (const std::int32_t v : way) radius.push_back(radius_at(v));
    ShapePiece<2> piece{{}, {}, curve.tag, curve.left_inside, curve.right_inside};
    if (curve.evaluate) return add_chords(curve, way, radius, piece);
    for (std::size_t p = 0; p + 1 < way.size(); ++p) {
      piece.edge = distance<2>(curve.points[p], curve.points[p + 1]);
      piece.radius = std::min(radius[p], radius[p + 1]);
      add(piece, curve.points[p], curve.points[p + 1], way[p], way[p + 1]);
    }
  }

  // Divides each chord so that parts stay within kMaxCurveSag of the curve. The distance decreases
  // with the square of the number of parts, because samples turn by at most kSampleTurn.
  void add_chords(const BoundaryCurve& curve, const std::vector<std::int32_t>& way,
                  const std::vector<double>& radius, ShapePiece<2> piece) {
    std::vector<double> parameters;
    std::vector<std::int64_t> parts;
    for (std::size_t p = 0; p + 1 < way.size(); ++p) {
      const double sag = kSampleTurn / 8 * distance<2>(curve.points[p], curve.points[p + 1]);
      const auto count =
          std::max(std::int64_t{1},
                   static_cast<std::int64_t>(std::ceil(std::sqrt(sag / (kMaxCurveSag * size_)))));
      parts.push_back(count);
      const double t = curve.parameters[p], step = curve.parameters[p + 1] - t;
      for (std::int64_t k = 1; k < count; ++k)
        parameters.push_back(t + step * static_cast<double>(k) / static_cast<double>(count));
    }
    const std::vector<Point<2>> between = curve_points(curve.evaluate, parameters, curve.name);
    auto next = between.begin();
    for (std::size_t p = 0; p + 1 < way.size(); ++p) {
      piece.radius = std::min(radius[p], radius[p + 1]);
      Point<2> from = curve.points[p];
      std::int32_t begin = way[p];
      for (std::int64_t k = 1; k < parts[p]; ++k, ++next) {
        const auto end = static_cast<std::int32_t>(vertices_.size());
        vertices_.push_back({*next});
        add(piece, from, *next, begin, end);
        from = *next;
        begin = end;
      }
      add(piece, from, curve.points[p + 1], begin, way[p + 1]);
    }
  }

  void add(ShapePiece<2> piece, const Point<2>& a, const Point<2>& b, std::int32_t begin,
           std::int32_t end) {
    piece.corners = {a, b};
    piece.ends = {begin, end};
    shape_.push_back(piece);
  }

  // Adds fixed nodes and corners, which may have tags of their own, as points.
  void add_points() {
    for (std::size_t c = 0; c < domain_.corners().size(); ++c) {
      const Corner& corner = domain_.corners()[c];
      const auto number = static_cast<std::int32_t>(c);
      add({{}, {}, corner.tag, true, true}, corner.position, corner.position, number, number);
    }
    for (const FixedNode<2>& node : domain_.fixed_nodes()) {
      const auto number = static_cast<std::int32_t>(vertices_.size());
      vertices_.push_back({node.position});
      add({{}, {}, node.tag, true, true}, node.position, node.position, number, number);
    }
  }

  const PlaneDomain& domain_;
  double size_;
  std::vector<Vertex> vertices_;
  std::vector<std::vector<std::int32_t>> ways_;  // vertices of each curve
  Shape<2> shape_;
};

}  // namespace

Shape<2> shape_of(const PlaneDomain& domain) { return PlaneShape(domain).run(); }

}  // namespace pnpbs
