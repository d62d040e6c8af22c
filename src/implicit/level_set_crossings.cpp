// SPDX-License-Identifier: BSD-3-Clause
#include "implicit/level_set_crossings.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <utility>

#include "base/index.hpp"
#include "base/space_vectors.hpp"
#include "implicit/level_set.hpp"

namespace pnpbs {

namespace {

class CrossingFinder {
 public:
  using Edge = std::array<std::int32_t, 2>;  // vertices, ascending

  CrossingFinder(const LevelSet& set, SurfaceSource& smooth) : set_(set), smooth_(smooth) {}

  LevelSetCrossings run(bool third_sides) {
    find_normals(vertices_at_bends());
    constexpr int kSplits = 3;  // most rounds of splitting
    for (int k = 0; find_edges() > 0 && third_sides && k < kSplits; ++k)
      if (!split_missed()) break;
    if (!found_.edges.empty()) {
      gather_neighbours();
      find_corners();
    }
    return std::move(found_);
  }

 private:
  const Point<3>& x(std::int32_t v) const { return smooth_.vertices[index(v)]; }
  const Point<3>& normal(std::int32_t v) const { return found_.normals[index(v)]; }

  // ------------------------------------------------------------ normals
  // Returns the vertices near those whose triangles turn; f is evaluated only there. Thin triangles
  // are ignored, because beside a bend of a smooth surface they may face anywhere.
  std::vector<char> vertices_at_bends() const {
    // Angle between triangles at a bend [radians], and height of a thin triangle. [longest edge]
    constexpr double kBend = 10 * std::numbers::pi / 180, kThin = 0.05;
    std::vector<Point<3>> first(smooth_.vertices.size());
    std::vector<char> bends(smooth_.vertices.size(), 0), near(bends);
    for (const auto& t : smooth_.triangles) {
      const Point<3> area = cross(difference(x(t[1]), x(t[0])), difference(x(t[2]), x(t[0])));
      double longest = 0;
      for (std::size_t k = 0; k < 3; ++k)
        longest = std::max(longest, squared_distance<3>(x(t[k]), x(t[(k + 1) % 3])));
      if (length(area) < kThin * longest) continue;
      const Point<3> unit = unit_vector(area);
      for (const std::int32_t v : t) {
        if (first[index(v)] == Point<3>{}) first[index(v)] = unit;
        if (!turn_less(first[index(v)], unit, kBend)) bends[index(v)] = 1;
      }
    }
    for (const auto& t : smooth_.triangles)
      if (bends[index(t[0])] + bends[index(t[1])] + bends[index(t[2])] > 0)
        for (const std::int32_t v : t) near[index(v)] = 1;
    return near;
  }

  void find_normals(const std::vector<char>& wanted) {
    found_.normals.resize(smooth_.vertices.size());
    std::vector<std::int32_t> asked;
    std::vector<Point<3>> places;
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(wanted.size()); ++v)
      if (wanted[index(v)] != 0) {
        asked.push_back(v);
        places.push_back(x(v));
      }
    const std::vector<LevelSetSlope> slopes = set_.slopes(places);
    std::vector<char> on_kink(smooth_.vertices.size(), 0);
    for (std::size_t k = 0; k < asked.size(); ++k) {
      found_.normals[index(asked[k])] = slopes[k].normal();
      if (slopes[k].kink > kSmooth) on_kink[index(asked[k])] = 1;
    }
    take_sides(on_kink);
  }

  // A vertex on an edge of the surface gets the normal of a side on which one of its triangles
  // lies.
  void take_sides(std::vector<char>& on_kink) {
    // Distance at which the side is sampled. [resolution]
    constexpr double kAside = 0.01;
    for (const auto& t : smooth_.triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t v = t[k];
        if (on_kink[index(v)] == 0) continue;
        Point<3> way = difference(x(t[(k + 1) % 3]), x(v));
        way = unit_vector(shifted(way, 1, difference(x(t[(k + 2) % 3]), x(v))));
        const Point<3> aside = shifted(x(v), kAside * set_.resolution(), way);
        const LevelSetSlope slope = set_.slopes({&aside, 1}).front();
        if (slope.kink > kSmooth) continue;
        found_.normals[index(v)] = slope.normal();
        on_kink[index(v)] = 0;
      }
  }

  // ------------------------------------------------------------ edges
  // Searches edges that have new vertices. Returns the number at which the surface turns but no
  // crossing was found.
  std::size_t find_edges() {
    std::vector<Edge> edges;
    for (const auto& t : smooth_.triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t a = t[k], b = t[(k + 1) % 3];  // the other triangle has b, a
        const Point<3>&p = normal(a), &q = normal(b);
        if (a < b && std::max(a, b) >= first_new_ && p != Point<3>{} && q != Point<3>{} &&
            !turn_less(p, q, kKinkAngle / 2))
          edges.push_back({a, b});
      }
    first_new_ = static_cast<std::int32_t>(smooth_.vertices.size());
    std::sort(edges.begin(), edges.end());
    const std::size_t known = found_.edges.size();
    edges = search(edges, [&](const Edge& e) { return along(e); });
    look_from_above(known);
    std::erase_if(edges,
                  [&](const Edge& e) { return turn_less(normal(e[0]), normal(e[1]), kKinkAngle); });
    missed_ = search(edges, [&](const Edge& e) { return across(e); });
    return missed_.size();
  }

  // Stores the crossings found and returns the edges without one.
  template <class SearchOf>
  std::vector<Edge> search(const std::vector<Edge>& edges, const SearchOf& search_of) {
    std::vector<CreaseSearch> searches;
    for (const Edge& e : edges) searches.push_back(search_of(e));
    const auto points = find_crease_points(set_, searches);
    std::vector<Edge> missed;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      if (points[e]) {
        found_.edges.push_back({edges[e], *points[e]});
      } else {
        missed.push_back(edges[e]);
      }
    }
    return missed;
  }

  CreaseSearch along(const Edge& e) const {
    return {{x(e[0]), x(e[1])}, shifted(normal(e[0]), 1, normal(e[1]))};
  }

  // Repeats the search with the mean of the normals at the crossings as `up`. This mean changes
  // less from edge to edge than that of the vertices' normals, so crossings follow the surface's
  // edge more evenly.
  void look_from_above(std::size_t begin) {
    std::vector<CreaseSearch> searches;
    for (std::size_t k = begin; k < found_.edges.size(); ++k) {
      const auto& [vertices, at] = found_.edges[k];
      searches.push_back(
          {{x(vertices[0]), x(vertices[1])}, shifted(at.normals[0], 1, at.normals[1])});
    }
    const auto points = find_crease_points(set_, searches);
    for (std::size_t k = 0; k < points.size(); ++k)
      if (points[k]) found_.edges[begin + k].at = *points[k];
  }

  // Returns a search perpendicular to the surface's edge. It succeeds where the triangulation's
  // edge is nearly parallel to that edge and the search along it fails.
  CreaseSearch across(const Edge& e) const {
    constexpr double kAside = 0.25, kInside = 0.1;  // fractions of the edge's length
    const Point<3>&p = normal(e[0]), &q = normal(e[1]);
    const Point<3> up = unit_vector(shifted(p, 1, q)), way = difference(x(e[1]), x(e[0]));
    Point<3> aside = unit_vector(cross(cross(p, q), up));
    if (dot(aside, way) < 0) aside = shifted({}, -1, aside);
    // The fraction of the edge at which the tangent planes of its ends meet.
    const double sine = dot(p, aside) * dot(q, up) - dot(p, up) * dot(q, aside);
    const double part = -dot(p, up) * dot(q, way) / (sine * dot(aside, way));
    const double inside = part > kInside ? std::min(part, 1 - kInside) : kInside;
    const Point<3> middle = shifted(x(e[0]), inside, way);
    const double reach = kAside * length(way);
    return {{shifted(middle, -reach, aside), shifted(middle, reach, aside)}, up};
  }

  // ------------------------------------------------------------ third sides
  // Puts a vertex onto each third side that a missed edge skips, where the normal differs from
  // those at both ends. Returns true if there is any.
  bool split_missed() {
    std::vector<CrossedSegment> segments;
    std::vector<std::size_t> of;
    for (std::size_t m = 0; m < missed_.size(); ++m) add_segments(m, segments, of);
    const std::vector<Point<3>> places = zeros_on(set_, segments);
    const std::vector<LevelSetSlope> slopes = set_.slopes(places);
    std::vector<std::size_t> best(missed_.size(), places.size());
    const auto likeness = [&](std::size_t k) {
      const Edge& e = missed_[of[k]];
      const Point<3> n = slopes[k].normal();
      return std::max(dot(n, normal(e[0])), dot(n, normal(e[1])));
    };
    for (std::size_t k = 0; k < places.size(); ++k)
      if (likeness(k) < std::cos(kKinkAngle / 2) && slopes[k].kink <= kSmooth &&
          (best[of[k]] == places.size() || likeness(k) < likeness(best[of[k]])))
        best[of[k]] = k;
    std::map<Edge, std::int32_t> vertex_on;
    for (std::size_t m = 0; m < missed_.size(); ++m) {
      if (best[m] == places.size()) continue;
      vertex_on[missed_[m]] = static_cast<std::int32_t>(smooth_.vertices.size());
      smooth_.vertices.push_back(places[best[m]]);
      found_.normals.push_back(slopes[best[m]].normal());
    }
    split(vertex_on);
    return !vertex_on.empty();
  }

  // Adds segments that go up or down from the missed edge to points where f has the other sign.
  void add_segments(std::size_t m, std::vector<CrossedSegment>& segments,
                    std::vector<std::size_t>& of) const {
    const Edge& e = missed_[m];
    const Point<3> way = difference(x(e[1]), x(e[0]));
    const Point<3> up = unit_vector(shifted(normal(e[0]), 1, normal(e[1])));
    for (const double part : {0.2, 0.35, 0.5, 0.65, 0.8}) {
      const Point<3> low = shifted(x(e[0]), part, way);
      for (const double rise : {1.0, -1.0}) {
        const Point<3> high = shifted(low, rise * length(way), up);
        const std::vector<LevelSetSlope> f = set_.slopes(std::array{low, high});
        if ((f[0].f < 0) == (f[1].f < 0)) continue;
        segments.push_back({f[0].x, f[1].x, f[0].f, f[1].f});
        of.push_back(m);
        break;
      }
    }
  }

  // Splits the triangles at the given edges, edge by edge and in ascending order of triangles.
  void split(const std::map<Edge, std::int32_t>& vertex_on) {
    std::map<Edge, std::vector<std::size_t>> triangles_at;
    for (std::size_t t = 0; t < smooth_.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& v = smooth_.triangles[t];
        const Edge edge = edge_of(v[k], v[(k + 1) % 3]);
        if (vertex_on.contains(edge)) triangles_at[edge].push_back(t);
      }
    for (const auto& [edge, vertex] : vertex_on) {
      std::vector<std::size_t> triangles = triangles_at[edge];
      std::sort(triangles.begin(), triangles.end());
      for (const std::size_t t : triangles) {
        const std::size_t added = split(t, edge, vertex);
        const auto moved =
            triangles_at.find(edge_of(smooth_.triangles[added][1], smooth_.triangles[added][2]));
        if (moved != triangles_at.end())
          std::replace(moved->second.begin(), moved->second.end(), t, added);
      }
    }
  }

  // Splits triangle t at a vertex on its edge. Returns the new triangle, whose first corner is the
  // vertex and which has the second end of the edge.
  std::size_t split(std::size_t t, const Edge& edge, std::int32_t vertex) {
    auto& v = smooth_.triangles[t];
    std::size_t k = 0;
    while (edge_of(v[k], v[(k + 1) % 3]) != edge) ++k;
    const std::int32_t a = v[k], b = v[(k + 1) % 3], c = v[(k + 2) % 3];
    v = {a, vertex, c};
    smooth_.triangles.push_back({vertex, b, c});
    smooth_.tags.push_back(smooth_.tags[t]);
    return smooth_.triangles.size() - 1;
  }

  // ------------------------------------------------------------ corners
  void gather_neighbours() {
    begin_.assign(smooth_.vertices.size() + 1, 0);
    for (const auto& t : smooth_.triangles)
      for (const std::int32_t v : t) ++begin_[index(v) + 1];
    for (std::size_t v = 0; v < smooth_.vertices.size(); ++v) begin_[v + 1] += begin_[v];
    next_.resize(begin_.back());
    std::vector<std::size_t> place(begin_.begin(), begin_.end() - 1);
    for (const auto& t : smooth_.triangles)
      for (std::size_t k = 0; k < 3; ++k) next_[place[index(t[k])]++] = t[(k + 1) % 3];
    crossings_at_.resize(smooth_.vertices.size());
    for (std::size_t e = 0; e < found_.edges.size(); ++e)
      for (const std::int32_t v : found_.edges[e].vertices)
        crossings_at_[index(v)].push_back(static_cast<std::int32_t>(e));
  }

  // Returns v and the vertices connected to it within a distance.
  std::vector<std::int32_t> around(std::int32_t v, double reach) const {
    std::vector<std::int32_t> found{v};
    for (std::size_t k = 0; k < found.size(); ++k)
      for (std::size_t n = begin_[index(found[k])]; n < begin_[index(found[k]) + 1]; ++n)
        if (distance<3>(x(next_[n]), x(v)) <= reach &&
            std::find(found.begin(), found.end(), next_[n]) == found.end())
          found.push_back(next_[n]);
    return found;
  }

  // Searches for corners, where three edges or more meet, in neighbourhoods of increasing size.
  void find_corners() {
    constexpr double kReaches[] = {0.5, 0.75, 1.1, 1.5}, kSame = 0.6;  // [resolution]
    const double h = set_.resolution();
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(smooth_.vertices.size()); ++v) {
      if (crossings_at_[index(v)].empty()) continue;
      const bool known = std::any_of(
          found_.corners.begin(), found_.corners.end(),
          [&](const SurfaceCorner& c) { return distance<3>(c.position, x(v)) < kSame * h; });
      for (std::size_t k = 0; k < std::size(kReaches) && !known; ++k)
        if (add_corner(v, around(v, kReaches[k] * h))) break;
    }
  }

  bool add_corner(std::int32_t v, std::vector<std::int32_t> near) {
    constexpr double kOne = 0.1;  // corners closer than this are one [resolution]
    std::vector<CornerSide> sides = sides_around(near);
    if (sides.size() < 3) return false;
    Point<3> up{};
    for (const CornerSide& side : sides) up = shifted(up, 1, side.normal);
    const std::optional<Point<3>> corner = find_corner(set_, x(v), std::move(sides));
    if (!corner) return false;
    for (const SurfaceCorner& c : found_.corners)
      if (distance<3>(c.position, *corner) < kOne * set_.resolution()) return true;
    std::stable_sort(near.begin(), near.end(), [&](std::int32_t a, std::int32_t b) {
      return squared_distance<3>(x(a), *corner) < squared_distance<3>(x(b), *corner);
    });
    found_.corners.push_back({*corner, unit_vector(up), std::move(near)});
    return true;
  }

  std::vector<CornerSide> sides_around(const std::vector<std::int32_t>& near) const {
    constexpr double kBeside = 0.2;  // fraction of the distance to a vertex
    std::vector<CornerSide> sides;
    const auto is_new = [&](const Point<3>& n) {
      return std::all_of(sides.begin(), sides.end(), [&](const CornerSide& side) {
        return !turn_less(n, side.normal, kKinkAngle / 2);
      });
    };
    for (const std::int32_t v : near)
      for (const std::int32_t e : crossings_at_[index(v)])
        for (const Point<3>& n : found_.edges[index(e)].at.normals)
          if (is_new(n)) sides.push_back({n, {}});
    const auto add = [&](const Point<3>& n, const Point<3>& place) {
      const auto side = std::max_element(sides.begin(), sides.end(),
                                         [&](const CornerSide& p, const CornerSide& q) {
                                           return dot(p.normal, n) < dot(q.normal, n);
                                         });
      if (side != sides.end() && turn_less(side->normal, n, kKinkAngle / 2))
        side->samples.push_back(place);
    };
    for (const std::int32_t v : near) add(normal(v), x(v));
    // Samples beside the crossings are needed because a side may have no vertex here.
    for (const std::int32_t v : near)
      for (const std::int32_t e : crossings_at_[index(v)])
        for (const std::size_t end : {0, 1}) {
          const auto& [vertices, at] = found_.edges[index(e)];
          const Point<3> way = difference(x(vertices[end]), at.position);
          add(at.normals[end], shifted(at.position, kBeside, way));
        }
    std::erase_if(sides, [](const CornerSide& side) { return side.samples.empty(); });
    return sides;
  }

  static constexpr double kSmooth = 0.01;  // LevelSetSlope::kink of smooth points is less

  const LevelSet& set_;
  SurfaceSource& smooth_;
  LevelSetCrossings found_;
  std::vector<Edge> missed_;        // the surface turns across them, but no crossing was found
  std::int32_t first_new_ = 0;      // edges between lower vertices were searched already
  std::vector<std::size_t> begin_;  // first index of each vertex in next_
  std::vector<std::int32_t> next_;
  std::vector<std::vector<std::int32_t>> crossings_at_;
};

}  // namespace

LevelSetCrossings find_crossings(const LevelSet& set, SurfaceSource& smooth, bool third_sides) {
  return CrossingFinder(set, smooth).run(third_sides);
}

}  // namespace pnpbs
