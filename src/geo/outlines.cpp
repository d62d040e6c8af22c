// SPDX-License-Identifier: BSD-3-Clause
#include "geo/outlines.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <tuple>

#include "base/error.hpp"
#include "geo/chains.hpp"
#include "sphere/area_in_chart.hpp"

namespace pnpbs::geo {
namespace {

using Place = std::int64_t;

// A segment of a route, from the lower place to the higher one or the other way round.
struct Piece {
  Place low, high;
  bool upward;
  bool of_line;
  std::int64_t feature;
  std::int32_t tag;
  std::int64_t order;  // in the file
  std::tuple<Place, Place, bool, std::int64_t> key() const { return {low, high, of_line, order}; }
};

// Twice the area, positive if the places go round against the clock.
double turning_area(const std::vector<Place>& places, const std::vector<Point<2>>& points) {
  const Point<2>& o = points[places.front()];
  double area = 0;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const Point<2>&a = points[places[i]], &b = points[places[i + 1]];
    area += (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
  }
  return area;
}

// On a sphere an outline encloses the smaller of its two sides, which may hold the point that is
// projected from.
bool turns_left(const std::vector<Place>& places, const std::vector<Point<2>>& points,
                double radius) {
  if (radius == 0) return turning_area(places, points) > 0;
  double area = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
    area += area_beside(points[places[i]], points[places[(i + 1) % places.size()]], radius);
  const bool is_smaller = std::fabs(area) < 2 * std::numbers::pi * radius * radius;
  return (area > 0) == is_smaller;
}

// Each place once in a row; the inside on the left of outlines and holes.
void straighten(Route& route, const std::vector<Point<2>>& points, double radius) {
  std::vector<Place>& places = route.places;
  places.erase(std::unique(places.begin(), places.end()), places.end());
  if (route.kind == PathKind::line) return;
  while (places.size() > 1 && places.front() == places.back()) places.pop_back();
  if (places.empty()) return;
  if (turns_left(places, points, radius) != (route.kind == PathKind::outline))
    std::reverse(places.begin(), places.end());
}

std::vector<Piece> pieces_of(const std::vector<Route>& routes) {
  std::vector<Piece> pieces;
  for (const Route& route : routes) {
    const bool line = route.kind == PathKind::line;
    const std::size_t count = route.places.size();
    if (count < 2) continue;
    for (std::size_t i = 0; i < (line ? count - 1 : count); ++i) {
      const Place a = route.places[i], b = route.places[(i + 1) % count];
      pieces.push_back({std::min(a, b), std::max(a, b), a < b, line, route.feature, route.tag,
                        static_cast<std::int64_t>(pieces.size())});
    }
  }
  std::sort(pieces.begin(), pieces.end(),
            [](const Piece& a, const Piece& b) { return a.key() < b.key(); });
  return pieces;
}

class EdgeSorter {
 public:
  EdgeSorter(const WordsFor& where, Outlines& outlines, std::vector<Edge>& edges)
      : where_(where), outlines_(outlines), edges_(edges) {}

  // All pieces between two places, those of outlines first.
  void take(std::vector<Piece> pieces) {
    const std::size_t given = pieces.size();
    cancel_within_features(pieces);
    const auto first_line = std::find_if(pieces.begin(), pieces.end(), &is_line);
    const auto outlines = first_line - pieces.begin();
    const bool has_line = first_line != pieces.end();
    if (has_line) {
      outlines_.lost_tags += std::count_if(first_line, pieces.end(), [&](const Piece& piece) {
        return piece.tag != first_line->tag;
      });
      if (outlines > 0) ++outlines_.retagged_edges, pieces.front().tag = first_line->tag;
    }
    if (outlines == 0 && !pieces.empty())
      add(pieces.front(), EdgeRole::line);
    else if (outlines == 1)
      add(pieces.front(), EdgeRole::boundary);
    else if (outlines == 2 && pieces[0].upward != pieces[1].upward)
      add(pieces.front(), EdgeRole::inner), ++outlines_.shared_edges;
    else if (outlines > 1)
      reject_overlap(pieces[0], pieces[1]);
    const std::size_t meant = pieces.empty()             ? 0
                              : outlines > 0 && has_line ? outlines + 1
                                                         : std::max<std::ptrdiff_t>(outlines, 1);
    outlines_.dropped_edges += static_cast<std::int64_t>(given - meant);
  }

 private:
  static bool is_line(const Piece& piece) { return piece.of_line; }

  // What one feature goes along there and back has its area on both sides: the cut at 180 degrees,
  // the way to a pole, a spike.
  static void cancel_within_features(std::vector<Piece>& pieces) {
    std::vector<Piece> left;  // those of a feature stand together
    for (const Piece& piece : pieces) {
      const bool back = !left.empty() && !piece.of_line && !left.back().of_line &&
                        left.back().feature == piece.feature && left.back().upward != piece.upward;
      if (back)
        left.pop_back();
      else
        left.push_back(piece);
    }
    pieces = std::move(left);
  }

  void add(const Piece& piece, EdgeRole role) {
    edges_.push_back({piece.upward ? piece.low : piece.high, piece.upward ? piece.high : piece.low,
                      role, piece.tag, piece.order, piece.of_line});
  }

  [[noreturn]] void reject_overlap(const Piece& a, const Piece& b) const {
    const std::string features =
        a.feature == b.feature ? "feature " + std::to_string(a.feature) + " covers an area twice"
                               : "features " + std::to_string(a.feature) + " and " +
                                     std::to_string(b.feature) + " overlap";
    throw Error(ErrorKind::domain, features + ", on the same side of the edge from " +
                                       where_(a.low) + " to " + where_(a.high));
  }

  const WordsFor& where_;
  Outlines& outlines_;
  std::vector<Edge>& edges_;
};

}  // namespace

std::size_t Places::Hash::operator()(const Point<2>& point) const {
  // Any mixing of the bits will do: the numbers go by the order of points, not by this.
  std::uint64_t mixed = std::bit_cast<std::uint64_t>(point[0]) * 0x9E3779B97F4A7C15u;
  mixed = std::rotl(mixed, 29) ^ std::bit_cast<std::uint64_t>(point[1]);
  mixed *= 0xBF58476D1CE4E5B9u;
  return mixed ^ (mixed >> 32);
}

std::int64_t Places::add(const Point<2>& point) {
  const Point<2> unsigned_zeros{point[0] + 0.0, point[1] + 0.0};
  const auto next = static_cast<std::int64_t>(points_.size());
  const auto [found, is_new] = numbers_.try_emplace(unsigned_zeros, next);
  if (is_new) points_.push_back(unsigned_zeros);
  return found->second;
}

// Outlines have their polygon on the left: around the point that the sphere is seen from, which is
// the infinite one of its projection, they turn right.
void Outlines::leave_out_shared_edges_outside(const std::vector<Point<2>>& points) {
  double twice_area = 0;
  for (const Curve& curve : curves) {
    if (!curve.bounds || curve.of_line) continue;
    for (std::size_t k = 0; k < segments_of(curve); ++k) {
      const Point<2>&a = points[curve.places[k]], &b = points[end_of(curve, k)];
      twice_area += a[0] * b[1] - a[1] * b[0];
    }
  }
  if (twice_area >= 0) return;
  std::erase_if(curves, [this](const Curve& curve) {
    if (curve.bounds || curve.of_line) return false;
    outer_edges += static_cast<std::int64_t>(segments_of(curve));
    return true;
  });
}

Outlines outlines_of(std::vector<Route> routes, const std::vector<Point<2>>& points,
                     const WordsFor& where, double radius) {
  for (Route& route : routes) straighten(route, points, radius);
  const std::vector<Piece> pieces = pieces_of(routes);
  Outlines outlines;
  std::vector<Edge> edges;
  EdgeSorter sorter(where, outlines, edges);
  for (std::size_t begin = 0, end; begin < pieces.size(); begin = end) {
    for (end = begin; end < pieces.size() && pieces[end].low == pieces[begin].low &&
                      pieces[end].high == pieces[begin].high;)
      ++end;
    sorter.take({pieces.begin() + static_cast<std::ptrdiff_t>(begin),
                 pieces.begin() + static_cast<std::ptrdiff_t>(end)});
  }
  std::sort(edges.begin(), edges.end(),
            [](const Edge& a, const Edge& b) { return a.order < b.order; });
  settle_lines(edges, points, where);
  outlines.curves = chains_of(edges, static_cast<std::int64_t>(points.size()));
  return outlines;
}

}  // namespace pnpbs::geo
