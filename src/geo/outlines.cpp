// SPDX-License-Identifier: BSD-3-Clause
#include "geo/outlines.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <tuple>
#include <vector>

#include "base/error.hpp"
#include "base/union_find.hpp"
#include "sphere/area_in_chart.hpp"

namespace pnpbs::geo {
namespace {

// The use of an edge: part of the boundary, of an inner curve, or of a line whose use is not
// decided yet.
enum class EdgeRole { boundary, inner, line };

// An edge of polygons or lines.
struct Edge {
  std::int64_t begin, end;
  EdgeRole role;
  std::int32_t tag;
  std::int64_t order;
  bool of_line;
};

using Index = std::int64_t;

// Compressed rows of the edges at each vertex.
class Incidence {
 public:
  Incidence(const std::vector<Edge>& edges, Index places)
      : begin_(static_cast<std::size_t>(places) + 1, 0), edges_(2 * edges.size()) {
    for (const Edge& edge : edges) ++begin_[edge.begin + 1], ++begin_[edge.end + 1];
    for (std::size_t p = 1; p < begin_.size(); ++p) begin_[p] += begin_[p - 1];
    std::vector<Index> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t e = 0; e < edges.size(); ++e)
      for (const Index place : {edges[e].begin, edges[e].end})
        edges_[next[place]++] = static_cast<Index>(e);
  }

  Index degree(Index place) const { return begin_[place + 1] - begin_[place]; }
  const Index* at(Index place) const { return edges_.data() + begin_[place]; }

 private:
  std::vector<Index> begin_, edges_;
};

Index other_end(const Edge& edge, Index place) {
  return edge.begin == place ? edge.end : edge.begin;
}

// Marks the edges that belong to closed lines: removes edges with a free end until none is left.
// Updates `degree`, the number of edges at each vertex.
std::vector<char> without_branches(const std::vector<Edge>& edges, const Incidence& incidence,
                                   std::vector<Index>& degree) {
  std::vector<char> left(edges.size(), 1);
  std::vector<Index> loose;
  for (std::size_t p = 0; p < degree.size(); ++p)
    if (degree[p] == 1) loose.push_back(static_cast<Index>(p));
  while (!loose.empty()) {
    const Index place = loose.back();
    loose.pop_back();
    for (Index k = 0; k < incidence.degree(place); ++k) {
      const Index e = incidence.at(place)[k];
      if (!left[e]) continue;
      left[e] = 0;
      --degree[place];
      const Index other = other_end(edges[e], place);
      if (--degree[other] == 1) loose.push_back(other);
    }
  }
  return left;
}

// The curves that edges form.
class ChainMaker {
 public:
  ChainMaker(const std::vector<Edge>& edges, Index places)
      : edges_(edges), incidence_(edges, places), used_(edges.size(), 0) {}

  std::vector<Curve> run() {
    std::vector<Curve> chains;
    for (Index e = 0; e < static_cast<Index>(edges_.size()); ++e)
      if (!used_[e]) chains.push_back(chain_with(e));
    return chains;
  }

 private:
  // Returns whether a curve passes through the vertex: exactly two edges meet there, and they have
  // the same role.
  bool is_passed(Index place) const {
    if (incidence_.degree(place) != 2) return false;
    const Index* edges = incidence_.at(place);
    const Edge &a = edges_[edges[0]], &b = edges_[edges[1]];
    return a.role == b.role && a.of_line == b.of_line;
  }

  Index next_edge(Index place, Index edge) const {
    const Index* edges = incidence_.at(place);
    return edges[0] == edge ? edges[1] : edges[0];
  }

  // Follows the curve back to its beginning. Returns the first edge and vertex there. For a closed
  // curve, returns the given edge.
  std::pair<Index, Index> begin_of(Index edge) const {
    Index at = edge, place = edges_[edge].begin;
    while (is_passed(place)) {
      const Index before = next_edge(place, at);
      if (before == edge) return {edge, edges_[edge].begin};
      place = other_end(edges_[before], place);
      at = before;
    }
    return {at, place};
  }

  Curve chain_with(Index edge) {
    auto [at, place] = begin_of(edge);
    Curve curve{edges_[at].role == EdgeRole::boundary, false, {place}, {}, edges_[at].of_line};
    for (;;) {
      used_[at] = 1;
      curve.tags.push_back(edges_[at].tag);
      place = other_end(edges_[at], place);
      if (place == curve.places.front()) {
        curve.closed = true;
        return curve;
      }
      curve.places.push_back(place);
      if (!is_passed(place)) return curve;
      at = next_edge(place, at);
    }
  }

  const std::vector<Edge>& edges_;
  Incidence incidence_;
  std::vector<char> used_;
};

// Returns whether the point is inside the closed curves that the edges form, by the parity of
// crossings.
bool is_inside(const Point<2>& p, const std::vector<Edge>& edges,
               const std::vector<Point<2>>& points) {
  bool inside = false;
  for (const Edge& edge : edges) {
    const Point<2>&a = points[edge.begin], &b = points[edge.end];
    if ((a[1] > p[1]) == (b[1] > p[1])) continue;
    if (p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) inside = !inside;
  }
  return inside;
}

// The decision which lines bound the domain and which are inner curves, see classify_lines().
class LineClassifier {
 public:
  LineClassifier(std::vector<Edge>& edges, const std::vector<Point<2>>& points)
      : edges_(edges), points_(points), parts_(points.size()), in_outline_(points.size(), 0) {
    for (const Edge& edge : edges_) {
      if (edge.of_line) {
        lines_.push_back(edge);
        continue;
      }
      in_outline_[edge.begin] = in_outline_[edge.end] = 1;
      if (edge.role == EdgeRole::boundary) outlines_.push_back(edge);
    }
  }

  void run(const WordsFor& where) {
    if (lines_.empty()) return;
    find_closed();
    const std::vector<Index> candidates = parts_apart();
    const bool bound = outlines_.empty() || any_surrounds_a_polygon(candidates);
    std::vector<char> bounds(points_.size(), 0);  // by the root vertex of each part
    if (bound)
      for (const Index part : candidates) bounds[part] = 1;
    for (std::size_t p = 0; p < points_.size(); ++p)
      if (degree_[p] % 2 != 0 && bounds[part_of(p)])
        throw Error(ErrorKind::domain, std::to_string(degree_[p]) +
                                           " lines that are closed meet at " +
                                           where(static_cast<Index>(p)) +
                                           ": they do not define an interior: use polygons");
    std::size_t line = 0;
    for (Edge& edge : edges_) {
      if (!edge.of_line) continue;
      const bool is_bound = closed_[line++] && bounds[part_of(edge.begin)];
      edge.role = is_bound ? EdgeRole::boundary : EdgeRole::inner;
    }
  }

 private:
  Index part_of(std::size_t place) { return parts_.root(static_cast<Index>(place)); }
  Index part_of(Index place) { return parts_.root(place); }

  void find_closed() {
    const auto places = static_cast<Index>(points_.size());
    const Incidence incidence(lines_, places);
    degree_.resize(points_.size());
    for (Index p = 0; p < places; ++p) degree_[p] = incidence.degree(p);
    closed_ = without_branches(lines_, incidence, degree_);
    for (std::size_t e = 0; e < lines_.size(); ++e)
      if (closed_[e]) parts_.join(lines_[e].begin, lines_[e].end);
  }

  // Returns the parts of closed lines that neither meet a polygon nor lie inside one.
  std::vector<Index> parts_apart() {
    std::vector<char> meets(points_.size(), 0);
    std::vector<Index> all, apart;
    for (std::size_t e = 0; e < lines_.size(); ++e) {
      if (!closed_[e]) continue;
      const Index part = part_of(lines_[e].begin);
      all.push_back(part);
      if (in_outline_[lines_[e].begin] || in_outline_[lines_[e].end]) meets[part] = 1;
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    for (const Index part : all)
      if (!meets[part] && !is_inside(points_[part], outlines_, points_)) apart.push_back(part);
    return apart;
  }

  bool any_surrounds_a_polygon(const std::vector<Index>& candidates) {
    std::vector<char> is_candidate(points_.size(), 0);
    for (const Index part : candidates) is_candidate[part] = 1;
    std::vector<Edge> around;
    for (std::size_t e = 0; e < lines_.size(); ++e)
      if (closed_[e] && is_candidate[part_of(lines_[e].begin)]) around.push_back(lines_[e]);
    if (around.empty()) return false;
    UnionFind<Index> polygons(points_.size());
    for (const Edge& edge : outlines_) polygons.join(edge.begin, edge.end);
    return std::any_of(outlines_.begin(), outlines_.end(), [&](const Edge& edge) {
      return polygons.root(edge.begin) == edge.begin &&
             is_inside(points_[edge.begin], around, points_);
    });
  }

  std::vector<Edge>& edges_;
  const std::vector<Point<2>>& points_;
  std::vector<Edge> lines_, outlines_;  // outlines_: the boundary of the union of the polygons
  UnionFind<Index> parts_;              // connected parts of closed lines
  std::vector<char> in_outline_;        // by vertex
  std::vector<char> closed_;            // by line
  std::vector<Index> degree_;           // number of edges of closed lines at each vertex
};

// Sets the roles of lines. Closed lines that neither meet a polygon nor lie inside one bound the
// domain, if there are no polygons or such a line surrounds one. All other lines are inner curves.
// Throws Error if an odd number of closed lines meet at a vertex.
void classify_lines(std::vector<Edge>& edges, const std::vector<Point<2>>& points,
                    const WordsFor& where) {
  LineClassifier(edges, points).run(where);
}

// Joins all edges into curves, in the order of the first edges.
std::vector<Curve> chains_of(const std::vector<Edge>& edges, std::int64_t places) {
  return ChainMaker(edges, places).run();
}

using Place = std::int64_t;

// A segment of a route, stored from the smaller vertex index to the larger one.
struct Piece {
  Place low, high;
  bool upward;
  bool of_line;
  std::int64_t feature;
  std::int32_t tag;
  std::int64_t order;  // order in the file
  std::tuple<Place, Place, bool, std::int64_t> key() const { return {low, high, of_line, order}; }
};

// Returns twice the area that the vertices enclose, positive if they are counter-clockwise.
double turning_area(const std::vector<Place>& places, const std::vector<Point<2>>& points) {
  const Point<2>& o = points[places.front()];
  double area = 0;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const Point<2>&a = points[places[i]], &b = points[places[i + 1]];
    area += (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
  }
  return area;
}

// Returns whether the outline has its inside on the left. On a sphere an outline encloses the
// smaller of the two areas, which may contain the point of projection.
bool turns_left(const std::vector<Place>& places, const std::vector<Point<2>>& points,
                double radius) {
  if (radius == 0) return turning_area(places, points) > 0;
  double area = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
    area += chart_area_term(points[places[i]], points[places[(i + 1) % places.size()]], radius);
  const bool is_smaller = std::fabs(area) < 2 * std::numbers::pi * radius * radius;
  return (area > 0) == is_smaller;
}

// Removes repeated consecutive vertices. Orients outlines counter-clockwise and holes clockwise.
void normalize_route(Route& route, const std::vector<Point<2>>& points, double radius) {
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

// A converter of pieces to edges. All pieces between the same two vertices become at most one edge,
// and it counts the pieces that are merged or left out.
class EdgeSorter {
 public:
  EdgeSorter(const WordsFor& where, Outlines& outlines, std::vector<Edge>& edges)
      : where_(where), outlines_(outlines), edges_(edges) {}

  // Adds the edge for all pieces between two vertices, sorted with those of outlines first.
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

  // Removes pairs of opposite pieces of one feature, whose area lies on both sides: a cut at 180
  // degrees, the way to a pole, a spike.
  static void cancel_within_features(std::vector<Piece>& pieces) {
    std::vector<Piece> left;  // the pieces of a feature are consecutive
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
                                       where_(a.low) + " to " + where_(a.high) +
                                       ": unite them, or subtract one from the other");
  }

  const WordsFor& where_;
  Outlines& outlines_;
  std::vector<Edge>& edges_;
};

}  // namespace

std::size_t Places::Hash::operator()(const Point<2>& point) const {
  // Any hash function will do, because the numbers follow from the order of points.
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

// Outlines have their polygon on the left. In the projection from a point inside a polygon, their
// total signed area is negative.
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
  for (Route& route : routes) normalize_route(route, points, radius);
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
  classify_lines(edges, points, where);
  outlines.curves = chains_of(edges, static_cast<std::int64_t>(points.size()));
  return outlines;
}

}  // namespace pnpbs::geo
