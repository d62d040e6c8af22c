// SPDX-License-Identifier: BSD-3-Clause
#include "implicit/crease_cutting.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "base/index.hpp"
#include "base/space_vectors.hpp"

namespace pnpbs {

namespace {

using Triangle = std::array<std::int32_t, 3>;
using Edge = std::array<std::int32_t, 2>;  // ascending

class CreaseCutter {
 public:
  CreaseCutter(const SurfaceSource& smooth, const LevelSetCrossings& crossings,
               const std::vector<char>& care, double resolution)
      : smooth_(smooth), crossings_(crossings), care_(care), resolution_(resolution) {
    cut_.vertices = smooth.vertices;
    cut_.on_crease.assign(smooth.vertices.size(), 0);
  }

  CutSurface run() {
    triangles_ = smooth_.triangles;
    origins_.resize(triangles_.size());
    std::iota(origins_.begin(), origins_.end(), 0);
    triangles_at_.resize(smooth_.vertices.size());
    for (std::int32_t t = 0; t < std::ssize(triangles_); ++t) list(t);
    for (const SurfaceCorner& corner : crossings_.corners) insert(corner);
    move_to_edges();
    add_vertices();
    for (std::int32_t t = 0; t < std::ssize(triangles_); ++t)
      if (!is_gone(t)) cut(t);
    return std::move(cut_);
  }

 private:
  const Point<3>& x(std::int32_t v) const { return cut_.vertices[index(v)]; }
  bool on_crease(std::int32_t v) const { return cut_.on_crease[index(v)] != 0; }

  void list(std::int32_t t) {
    for (const std::int32_t v : triangles_[index(t)]) triangles_at_[index(v)].push_back(t);
  }
  bool is_gone(std::int32_t t) const { return triangles_[index(t)][0] < 0; }
  void remove(std::int32_t t) {
    for (const std::int32_t v : triangles_[index(t)]) std::erase(triangles_at_[index(v)], t);
    triangles_[index(t)][0] = -1;
  }

  // The triangle that has the edge from a to b, or -1.
  std::int32_t triangle_at(std::int32_t a, std::int32_t b) const {
    for (const std::int32_t t : triangles_at_[index(a)])
      for (std::size_t k = 0; k < 3; ++k)
        if (triangles_[index(t)][k] == a && triangles_[index(t)][(k + 1) % 3] == b) return t;
    return -1;
  }

  // ------------------------------------------------------------ corners
  // In place of the triangles around it come those from the corner to the edges around them.
  void insert(const SurfaceCorner& corner) {
    constexpr double kAround = 0.6, kWider = 1;  // resolutions
    const bool careful = std::any_of(corner.vertices.begin(), corner.vertices.end(),
                                     [&](std::int32_t v) { return care_[index(v)] > 0; });
    const double around = (careful ? kWider : kAround) * resolution_;
    std::set<std::int32_t> hole;
    for (const std::int32_t v : corner.vertices)
      if (hole.empty() || distance<3>(x(v), corner.position) < around)
        hole.insert(triangles_at_[index(v)].begin(), triangles_at_[index(v)].end());
    const std::map<std::int32_t, std::int32_t> rim = rim_seen_from(corner, hole);
    if (rim.empty() || !may_go(hole)) return;
    std::vector<std::pair<Triangle, std::int32_t>> fan;
    const auto apex = static_cast<std::int32_t>(cut_.vertices.size());
    for (const auto& [a, b] : rim)
      fan.push_back({{apex, a, b}, origins_[index(triangle_at(a, b))]});
    for (const std::int32_t t : hole) remove(t);
    cut_.vertices.push_back(corner.position);
    cut_.on_crease.push_back(1);
    triangles_at_.emplace_back();
    for (const auto& [triangle, origin] : fan) {
      triangles_.push_back(triangle);
      origins_.push_back(origin);
      list(static_cast<std::int32_t>(triangles_.size()) - 1);
    }
  }

  bool may_go(const std::set<std::int32_t>& hole) const {
    return std::all_of(hole.begin(), hole.end(), [&](std::int32_t t) {
      const Triangle& v = triangles_[index(t)];
      return std::none_of(v.begin(), v.end(), [&](std::int32_t corner) {
        return on_crease(corner) || care_[index(corner)] >= kLeftAlone;
      });
    });
  }

  // The edges around the hole, by their begins, once it has been widened until all of them turn
  // around the corner, as seen from above; empty if that does not come about.
  std::map<std::int32_t, std::int32_t> rim_seen_from(const SurfaceCorner& corner,
                                                     std::set<std::int32_t>& hole) const {
    constexpr int kMaxRounds = 20;
    constexpr double kWide = 0.05;  // sine of the angle between an edge and the way to it
    for (int round = 0; round < kMaxRounds; ++round) {
      std::map<std::int32_t, std::int32_t> rim;
      std::vector<std::int32_t> more;
      bool simple = true;
      for (const std::int32_t t : hole)
        for (std::size_t k = 0; k < 3; ++k) {
          const std::int32_t a = triangles_[index(t)][k], b = triangles_[index(t)][(k + 1) % 3];
          const std::int32_t beyond = triangle_at(b, a);
          if (hole.contains(beyond)) continue;
          simple = rim.insert({a, b}).second && simple;
          const Point<3> to_a = difference(x(a), corner.position), way = difference(x(b), x(a));
          if (dot(cross(to_a, way), corner.up) < kWide * length(to_a) * length(way))
            more.push_back(beyond);
        }
      if (more.empty()) return simple && is_one_ring(rim) ? rim : decltype(rim){};
      hole.insert(more.begin(), more.end());
    }
    return {};
  }

  static bool is_one_ring(const std::map<std::int32_t, std::int32_t>& rim) {
    std::size_t steps = 0;
    std::int32_t at = rim.begin()->first;
    do {
      const auto next = rim.find(at);
      if (next == rim.end()) return false;
      at = next->second;
      ++steps;
    } while (at != rim.begin()->first && steps < rim.size());
    return steps == rim.size() && at == rim.begin()->first;
  }

  // ------------------------------------------------------------ vertices that move
  static double shape(const Point<3>& twice_area, const std::array<Point<3>, 3>& corners) {
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k)
      longest = std::max(longest, squared_distance<3>(corners[k], corners[(k + 1) % 3]));
    return longest > 0 ? length(twice_area) / longest : 0;
  }

  // Do the triangles around v still look upwards if it goes there, and none becomes much thinner?
  bool may_move(std::int32_t v, const Point<3>& to, const Point<3>& up) const {
    constexpr double kThin = 0.02, kThinner = 0.5;  // height over the longest edge
    const std::vector<std::int32_t>& star = triangles_at_[index(v)];
    return std::all_of(star.begin(), star.end(), [&](std::int32_t t) {
      std::array<Point<3>, 3> now, then;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t corner = triangles_[index(t)][k];
        now[k] = x(corner);
        then[k] = corner == v ? to : now[k];
      }
      const auto area = [](const std::array<Point<3>, 3>& c) {
        return cross(difference(c[1], c[0]), difference(c[2], c[0]));
      };
      return dot(area(then), up) > 0 &&
             shape(area(then), then) >= std::min(kThin, kThinner * shape(area(now), now));
    });
  }

  // The nearest first, so far as they are much nearer than the other end.
  void move_to_edges() {
    constexpr double kNear = 0.3;    // of the way from end to end
    constexpr double kThere = 1e-4;  // resolutions
    std::vector<std::tuple<double, std::size_t, std::size_t>> moves;
    for (std::size_t e = 0; e < crossings_.edges.size(); ++e)
      for (const std::size_t end : {0, 1})
        if (part_from(e, end) < kNear) moves.push_back({part_from(e, end), e, end});
    for (std::size_t e = 0; e < crossings_.edges.size(); ++e)
      for (const std::int32_t v : crossings_.edges[e].vertices) edges_at_[v].push_back(e);
    std::sort(moves.begin(), moves.end());
    for (const auto& [part, e, end] : moves) {
      const CreaseCrossing& edge = crossings_.edges[e];
      const std::int32_t v = edge.vertices[end];
      if (care_[index(v)] > 0 || !is_cut(edge) || has_other_sides(v, edge.at)) continue;
      const Point<3>& to = edge.at.position;
      const Point<3> up = unit_vector(shifted(edge.at.normals[0], 1, edge.at.normals[1]));
      if (distance<3>(to, x(v)) > kThere * resolution_ && !may_move(v, to, up)) continue;
      cut_.vertices[index(v)] = to;
      cut_.on_crease[index(v)] = 1;
    }
  }

  double part_from(std::size_t e, std::size_t end) const {
    const CreaseCrossing& edge = crossings_.edges[e];
    const double from = distance<3>(edge.at.position, smooth_.vertices[index(edge.vertices[end])]),
                 to =
                     distance<3>(edge.at.position, smooth_.vertices[index(edge.vertices[1 - end])]);
    return from + to > 0 ? from / (from + to) : 0;
  }

  // ------------------------------------------------------------ vertices that come
  // Not where an end has come onto an edge or a corner of the surface.
  bool is_cut(const CreaseCrossing& edge) const {
    const auto& [a, b] = edge.vertices;
    if (triangle_at(a, b) < 0) return false;  // a corner is there now
    return std::none_of(edge.vertices.begin(), edge.vertices.end(), [&](std::int32_t v) {
      return care_[index(v)] >= kLeftAlone || on_crease(v);
    });
  }

  // Do edges lead from v to sides other than those that meet there?
  bool has_other_sides(std::int32_t v, const CreasePoint& at) const {
    const auto& edges = edges_at_.at(v);
    return std::any_of(edges.begin(), edges.end(), [&](std::size_t e) {
      const CreaseCrossing& other = crossings_.edges[e];
      return is_cut(other) && !between_same_sides(other.at, at);
    });
  }

  static bool between_same_sides(const CreasePoint& a, const CreasePoint& b) {
    return std::all_of(a.normals.begin(), a.normals.end(), [&](const Point<3>& n) {
      return std::any_of(b.normals.begin(), b.normals.end(), [&](const Point<3>& other) {
        return turn_less(n, other, kKinkAngle / 2);
      });
    });
  }

  void add_vertices() {
    for (const CreaseCrossing& edge : crossings_.edges) {
      if (!is_cut(edge)) continue;
      vertex_on_[edge.vertices] = static_cast<std::int32_t>(cut_.vertices.size());
      cut_.vertices.push_back(edge.at.position);
      cut_.on_crease.push_back(1);
    }
  }

  // ------------------------------------------------------------ triangles
  std::int32_t vertex_on(std::int32_t a, std::int32_t b) const {
    const auto found = vertex_on_.find(edge_of(a, b));
    return found == vertex_on_.end() ? -1 : found->second;
  }

  void cut(std::int32_t t) {
    const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
      cut_.triangles.push_back({a, b, c});
      cut_.origins.push_back(origins_[index(t)]);
    };
    Triangle v = triangles_[index(t)];
    const auto middles = [&] {
      return Triangle{vertex_on(v[0], v[1]), vertex_on(v[1], v[2]), vertex_on(v[2], v[0])};
    };
    Triangle m = middles();
    switch (3 - std::count(m.begin(), m.end(), -1)) {
      case 0:
        return add(v[0], v[1], v[2]);
      case 1:
        while (middles()[0] < 0) std::rotate(v.begin(), v.begin() + 1, v.end());
        m = middles();
        add(v[0], m[0], v[2]);
        return add(m[0], v[1], v[2]);
      case 2:  // around corner 0
        while (middles()[1] >= 0) std::rotate(v.begin(), v.begin() + 1, v.end());
        m = middles();
        add(v[0], m[0], m[2]);
        if (first_diagonal(v[1], v[2], m[2], m[0])) {
          add(m[0], v[1], v[2]);
          return add(m[0], v[2], m[2]);
        }
        add(m[0], v[1], m[2]);
        return add(m[2], v[1], v[2]);
      default:
        add(v[0], m[0], m[2]);
        add(v[1], m[1], m[0]);
        add(v[2], m[2], m[1]);
        return add(m[0], m[1], m[2]);
    }
  }

  // Of a quadrilateral abcd of which a and b are on one side: is it better cut from b to d than
  // from a to c? So that the triangles look where f does there; if both do, along the shorter one.
  bool first_diagonal(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) const {
    constexpr double kMatters = 0.05;
    const Point<3> up =
        unit_vector(shifted(crossings_.normals[index(a)], 1, crossings_.normals[index(b)]));
    const auto looks = [&](std::int32_t p, std::int32_t q, std::int32_t r) {
      return dot(up, unit_vector(cross(difference(x(q), x(p)), difference(x(r), x(p)))));
    };
    const double first = std::min(looks(d, a, b), looks(d, b, c)),
                 second = std::min(looks(d, a, c), looks(c, a, b));
    if (std::max(first, second) - std::min(first, second) > kMatters) return first > second;
    return squared_distance<3>(x(b), x(d)) <= squared_distance<3>(x(a), x(c));
  }

  const SurfaceSource& smooth_;
  const LevelSetCrossings& crossings_;
  const std::vector<char>& care_;
  double resolution_;
  CutSurface cut_;
  std::vector<Triangle> triangles_;  // with corners; of one that is gone, the first vertex is -1
  std::vector<std::int32_t> origins_;
  std::vector<std::vector<std::int32_t>> triangles_at_;        // of the vertices
  std::map<std::int32_t, std::vector<std::size_t>> edges_at_;  // crossed, of vertices
  std::map<Edge, std::int32_t> vertex_on_;
};

}  // namespace

CutSurface cut_at_creases(const SurfaceSource& smooth, const LevelSetCrossings& crossings,
                          const std::vector<char>& care, double resolution) {
  return CreaseCutter(smooth, crossings, care, resolution).run();
}

}  // namespace pnpbs
