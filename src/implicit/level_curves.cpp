// SPDX-License-Identifier: BSD-3-Clause
#include "implicit/level_curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "implicit/level_set.hpp"
#include "implicit/level_set_lattice.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

namespace {

constexpr double kCosCorner = 0.93969262078590838;  // 20 degrees; the curve is smooth below this
constexpr double kOnePoint = 1e-6;         // distance below which vertices coincide [resolution]
constexpr double kCornerTolerance = 1e-5;  // largest |f| at a corner [resolution]

Point<2> flat(const Point<3>& x) { return {x[0], x[1]}; }
Point<3> raised(const Point<2>& x, double z) { return {x[0], x[1], z}; }

// Returns the key of a side of a lattice square: its midpoint in half steps of the lattice.
std::uint64_t side_between(const LatticeIndex& a, const LatticeIndex& b) {
  return LevelSetLattice::key({a[0] + b[0], a[1] + b[1], 0});
}

std::array<LatticeIndex, 2> ends_of_side(std::uint64_t side) {
  const LatticeIndex middle = LevelSetLattice::place(side);
  return {LatticeIndex{middle[0] / 2, middle[1] / 2, 0},
          LatticeIndex{(middle[0] + 1) / 2, (middle[1] + 1) / 2, 0}};
}

// Returns the corners in counter-clockwise order.
std::array<LatticeIndex, 4> corners_of_square(const LatticeIndex& at) {
  return {LatticeIndex{at[0], at[1], 0}, LatticeIndex{at[0] + 1, at[1], 0},
          LatticeIndex{at[0] + 1, at[1] + 1, 0}, LatticeIndex{at[0], at[1] + 1, 0}};
}

// ------------------------------------------------------------------ marching squares -----------

// A piece of a curve inside a square, from side to side, with the region on its left.
struct Piece {
  std::uint64_t from, to;
  Box<2> square;
};

// Returns the pieces of the curves in all crossed squares. If a curve crosses a square twice, each
// piece goes around one corner that is in the region; the centre is then outside the region.
std::vector<Piece> pieces_in_squares(const LevelSetLattice& lattice) {
  std::vector<Piece> pieces;
  for (const LatticeIndex& square : lattice.crossed()) {
    const auto corners = corners_of_square(square);
    std::array<bool, 4> in;
    for (std::size_t k = 0; k < 4; ++k) in[k] = lattice.value(corners[k]) < 0;
    const auto side = [&](std::size_t k) { return side_between(corners[k], corners[(k + 1) % 4]); };
    for (std::size_t leaving = 0; leaving < 4; ++leaving) {
      if (!in[leaving] || in[(leaving + 1) % 4]) continue;
      std::size_t entering = (leaving + 3) % 4;  // go back past all corners that are in the region
      while (in[entering]) entering = (entering + 3) % 4;
      pieces.push_back({side(leaving),
                        side(entering),
                        {flat(lattice.position(corners[0])), flat(lattice.position(corners[2]))}});
    }
  }
  return pieces;
}

// ------------------------------------------------------------------ corners --------------------

// The value and the gradient of f at a point. They define a line on which the linearised f is 0.
struct Tangent {
  Point<2> at;
  double f;
  Point<2> gradient;
};

double product(const Point<2>& a, const Point<2>& b) { return a[0] * b[0] + a[1] * b[1]; }

bool turns(const Tangent& a, const Tangent& b) {
  const double both = std::sqrt(product(a.gradient, a.gradient) * product(b.gradient, b.gradient));
  return both > 0 && product(a.gradient, b.gradient) < kCosCorner * both;
}

std::optional<Point<2>> crossing(const Tangent& a, const Tangent& b) {
  const Point<2>&g = a.gradient, &h = b.gradient;
  const double determinant = g[0] * h[1] - g[1] * h[0];
  if (determinant == 0) return std::nullopt;
  const double c = product(g, a.at) - a.f, d = product(h, b.at) - b.f;
  return Point<2>{(c * h[1] - d * g[1]) / determinant, (g[0] * d - h[0] * c) / determinant};
}

// The search for a corner between two consecutive points of a curve.
struct CornerSearch {
  // Index of the piece between the two points.
  std::size_t piece;
  std::array<Point<2>, 2> from;  // the two points
  Box<2> square;  // contains the points and must contain the corner, so that pieces do not cross
  Point<2> x{};   // current estimate of the corner
};

class CurveCorners {
 public:
  CurveCorners(const LevelSet& set, std::vector<CornerSearch> open)
      : set_(set), z_(set.box().low[2]), open_(std::move(open)) {}

  // Returns the corner of each piece, if it has one.
  std::vector<std::optional<Point<2>>> run(std::size_t pieces) {
    // If the sides are curved, tangents nearer to the corner are more accurate.
    for (const double share : {1.0, 0.1, 0.01}) approach(share);
    std::vector<std::optional<Point<2>>> corners(pieces);
    std::vector<Point<3>> at;
    for (const CornerSearch& search : open_) at.push_back(raised(search.x, z_));
    const std::vector<LevelSetSlope> slope = set_.slopes(at);
    for (std::size_t k = 0; k < open_.size(); ++k)
      if (std::fabs(slope[k].f) <= kCornerTolerance * set_.resolution())
        corners[open_[k].piece] = open_[k].x;
    return corners;
  }

 private:
  // Evaluates tangents at a fraction of the distance from the corner to the points. Drops searches
  // at which the curve does not turn.
  void approach(double share) {
    std::vector<Point<3>> at;
    for (const CornerSearch& search : open_)
      for (const Point<2>& from : search.from)
        at.push_back(raised(share == 1 ? from : between(search.x, from, share), z_));
    const std::vector<LevelSetSlope> slopes = set_.slopes(at);
    std::vector<CornerSearch> turning;
    for (std::size_t k = 0; k < open_.size(); ++k) {
      const Tangent a = tangent(slopes[2 * k]), b = tangent(slopes[2 * k + 1]);
      const std::optional<Point<2>> x = turns(a, b) ? crossing(a, b) : std::nullopt;
      if (!x || !in_closed_box(open_[k].square, *x)) continue;
      turning.push_back(open_[k]);
      turning.back().x = *x;
    }
    open_ = std::move(turning);
  }

  static Point<2> between(const Point<2>& x, const Point<2>& from, double share) {
    return {x[0] + share * (from[0] - x[0]), x[1] + share * (from[1] - x[1])};
  }

  static Tangent tangent(const LevelSetSlope& slope) {
    return {flat(slope.x), slope.f, flat(slope.gradient)};
  }

  const LevelSet& set_;
  double z_;
  std::vector<CornerSearch> open_;
};

// ------------------------------------------------------------------ loops of pieces --------

class CurveWalk {
 public:
  CurveWalk(const LevelSet& set, std::vector<Piece> pieces, const LevelSetLattice& lattice)
      : pieces_(std::move(pieces)), one_(kOnePoint * set.resolution()) {
    std::ranges::sort(pieces_, {}, &Piece::from);
    std::vector<CrossedSegment> segments;
    for (const Piece& piece : pieces_) {
      const auto [low, high] = ends_of_side(piece.from);
      segments.push_back(
          {lattice.position(low), lattice.position(high), lattice.value(low), lattice.value(high)});
    }
    for (const Point<3>& zero : zeros_on(set, segments)) x_.push_back(flat(zero));
    std::vector<CornerSearch> searches;
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      searches.push_back({p, {x_[p], x_[next(p)]}, pieces_[p].square});
    corners_ = CurveCorners(set, std::move(searches)).run(pieces_.size());
  }

  std::vector<std::vector<LevelCurve>> run() {
    std::vector<std::vector<LevelCurve>> loops;
    std::vector<char> seen(pieces_.size());
    for (std::size_t first = 0; first < pieces_.size(); ++first) {
      if (seen[first] != 0) continue;
      std::vector<Vertex> loop;
      for (std::size_t p = first; seen[p] == 0; p = next(p)) {
        seen[p] = 1;
        add({x_[p], false}, loop);
        if (corners_[p]) add({*corners_[p], true}, loop);
      }
      close(loop);
      if (loop.size() >= 3) loops.push_back(from_corner_to_corner(loop));
    }
    return loops;
  }

 private:
  struct Vertex {
    Point<2> x;
    bool corner;
  };

  // Returns the piece that continues this one. Exactly one piece begins on each side on which one
  // ends.
  std::size_t next(std::size_t p) const {
    const auto found = std::ranges::lower_bound(pieces_, pieces_[p].to, {}, &Piece::from);
    return static_cast<std::size_t>(found - pieces_.begin());
  }

  // Appends a vertex. If it coincides with the last one, a corner replaces the other.
  void add(const Vertex& vertex, std::vector<Vertex>& loop) const {
    if (loop.empty() || distance<2>(loop.back().x, vertex.x) > one_)
      loop.push_back(vertex);
    else if (vertex.corner)
      loop.back() = vertex;
  }

  void close(std::vector<Vertex>& loop) const {
    while (loop.size() > 1 && distance<2>(loop.back().x, loop.front().x) <= one_) {
      if (loop.back().corner) loop.front() = loop.back();
      loop.pop_back();
    }
  }

  static std::vector<LevelCurve> from_corner_to_corner(std::vector<Vertex>& loop) {
    std::vector<LevelCurve> curves;
    const auto corner = std::ranges::find(loop, true, &Vertex::corner);
    LevelCurve curve{corner == loop.end(), {}};
    if (!curve.closed) {
      std::rotate(loop.begin(), corner, loop.end());
      loop.push_back(loop.front());
    }
    for (const Vertex& vertex : loop) {
      curve.points.push_back(vertex.x);
      if (!vertex.corner || curve.points.size() == 1) continue;
      curves.push_back(curve);
      curve.points = {vertex.x};
    }
    if (curve.closed) curves.push_back(curve);
    return curves;
  }

  std::vector<Piece> pieces_;  // ordered by the side on which they begin
  std::vector<Point<2>> x_;    // begin of each piece
  std::vector<std::optional<Point<2>>> corners_;
  double one_;
};

}  // namespace

std::vector<std::vector<LevelCurve>> level_curves(const LevelSet& set) {
  const LevelSetLattice lattice(set);
  return CurveWalk(set, pieces_in_squares(lattice), lattice).run();
}

}  // namespace pnpbs
