// SPDX-License-Identifier: BSD-3-Clause
#include "geo/chains.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/union_find.hpp"

namespace pnpbs::geo {
namespace {

using Index = std::int64_t;

// The edges at every place.
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

// Marks what is left of the edges when all those are taken away, again and again, that end where
// no other does.
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
  // Where one curve goes on: two edges of the same role meet, and no other.
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

  // Back along the curve to where it begins; all around it, if it is closed, to where it is.
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

// Whether the place lies behind an odd number of the edges.
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

class LineSettler {
 public:
  LineSettler(std::vector<Edge>& edges, const std::vector<Point<2>>& points)
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
    std::vector<char> bounds(points_.size(), 0);  // parts of lines, by their least place
    if (bound)
      for (const Index part : candidates) bounds[part] = 1;
    for (std::size_t p = 0; p < points_.size(); ++p)
      if (degree_[p] % 2 != 0 && bounds[part_of(p)])
        throw Error(ErrorKind::domain, std::to_string(degree_[p]) +
                                           " lines that are closed meet at " +
                                           where(static_cast<Index>(p)) +
                                           ": they do not define an interior; polygons do");
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

  // Closed parts that neither meet a polygon nor lie in one.
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
  std::vector<Edge> lines_, outlines_;  // outlines: the boundary of their union
  UnionFind<Index> parts_;              // of closed lines
  std::vector<char> in_outline_;        // of places
  std::vector<char> closed_;            // of lines
  std::vector<Index> degree_;           // of places, by closed lines
};

}  // namespace

void settle_lines(std::vector<Edge>& edges, const std::vector<Point<2>>& points,
                  const WordsFor& where) {
  LineSettler(edges, points).run(where);
}

std::vector<Curve> chains_of(const std::vector<Edge>& edges, std::int64_t places) {
  return ChainMaker(edges, places).run();
}

}  // namespace pnpbs::geo
