// SPDX-License-Identifier: BSD-3-Clause
#include "implicit/level_set_creases.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/index.hpp"
#include "base/limits.hpp"
#include "base/point_text.hpp"
#include "base/space_vectors.hpp"
#include "geometry/volume/triangle_contacts.hpp"
#include "implicit/level_set_crossings.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {
namespace {

// A triangulation that is cut along the edges of the surface. As in the extended marching cubes of
// Kobbelt and others (2001), vertices lie on edges and corners; here, however, nearby vertices are
// moved there, so that no needle-shaped triangles arise.
struct CutSurface {
  std::vector<Point<3>> vertices;  // those of the smooth surface first
  std::vector<std::array<std::int32_t, 3>> triangles;
  // Triangle of the smooth surface from which each triangle came.
  std::vector<std::int32_t> origins;
  std::vector<char> on_crease;  // of each vertex
};

// Levels of care at vertices of the smooth surface, raised where cutting fails. 0: vertices may
// move. 1: vertices stay, but edges that end there are cut. kLeftAlone: nothing is changed there.
constexpr char kLeftAlone = 2;

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

  // Returns the triangle that has the directed edge from a to b, or -1.
  std::int32_t triangle_at(std::int32_t a, std::int32_t b) const {
    for (const std::int32_t t : triangles_at_[index(a)])
      for (std::size_t k = 0; k < 3; ++k)
        if (triangles_[index(t)][k] == a && triangles_[index(t)][(k + 1) % 3] == b) return t;
    return -1;
  }

  // ------------------------------------------------------------ corners
  // Replaces the triangles around a corner by a fan from the corner to the edges around them.
  void insert(const SurfaceCorner& corner) {
    constexpr double kAround = 0.6, kWider = 1;  // [resolution]
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

  // Returns the edges around the hole, keyed by their first vertex. Widens the hole until all these
  // edges turn around the corner as seen from above. Returns an empty map if this fails.
  std::map<std::int32_t, std::int32_t> rim_seen_from(const SurfaceCorner& corner,
                                                     std::set<std::int32_t>& hole) const {
    constexpr int kMaxRounds = 20;
    // Least sine of the angle between an edge and the direction to it.
    constexpr double kWide = 0.05;
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

  // ------------------------------------------------------------ moved vertices
  static double shape(const Point<3>& twice_area, const std::array<Point<3>, 3>& corners) {
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k)
      longest = std::max(longest, squared_distance<3>(corners[k], corners[(k + 1) % 3]));
    return longest > 0 ? length(twice_area) / longest : 0;
  }

  // Returns true if after moving v the triangles around it still face upwards and none becomes much
  // thinner.
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

  // Moves vertices that are near crossings onto them, in ascending order of their distance. Only
  // the end that is clearly nearer to a crossing may move there.
  void move_to_edges() {
    constexpr double kNear = 0.3;  // largest fraction of the edge
    // Distance at which a vertex is already on the edge [resolution]
    constexpr double kThere = 1e-4;
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

  // ------------------------------------------------------------ new vertices
  // Returns true if the crossing still needs a vertex. It does not if a vertex at its ends lies on
  // an edge or a corner of the surface.
  bool is_cut(const CreaseCrossing& edge) const {
    const auto& [a, b] = edge.vertices;
    if (triangle_at(a, b) < 0) return false;  // replaced by a corner
    return std::none_of(edge.vertices.begin(), edge.vertices.end(), [&](std::int32_t v) {
      return care_[index(v)] >= kLeftAlone || on_crease(v);
    });
  }

  // Returns true if v has a crossing between other sides than those that meet at `at`.
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

  // Decides the diagonal of a quadrilateral abcd whose vertices a and b lie on one side of the
  // surface. Returns true for bd, false for ac. Prefers the diagonal whose triangles agree better
  // with the normal of f, and the shorter one if both do.
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
  std::vector<Triangle> triangles_;  // with corners; the first vertex of a removed triangle is -1
  std::vector<std::int32_t> origins_;
  std::vector<std::vector<std::int32_t>> triangles_at_;        // per vertex
  std::map<std::int32_t, std::vector<std::size_t>> edges_at_;  // crossed edges of each vertex
  std::map<Edge, std::int32_t> vertex_on_;
};

CutSurface cut_at_creases(const SurfaceSource& smooth, const LevelSetCrossings& crossings,
                          const std::vector<char>& care, double resolution) {
  return CreaseCutter(smooth, crossings, care, resolution).run();
}

Point<3> twice_area(const CutSurface& cut, const Triangle& t) {
  const Point<3>& a = cut.vertices[index(t[0])];
  return cross(difference(cut.vertices[index(t[1])], a), difference(cut.vertices[index(t[2])], a));
}

// ------------------------------------------------------------------ check of the result -------

// Detects triangles that cutting has made invalid.
class CutCheck {
 public:
  // Vertices from `first_new` on are new.
  CutCheck(std::int32_t first_new, const LevelSetCrossings& crossings, const CutSurface& cut,
           double resolution)
      : first_new_(first_new), crossings_(crossings), cut_(cut), resolution_(resolution) {}

  // Returns the triangles of the smooth surface from which invalid triangles came: those that face
  // the wrong way, cross others, or have hardly any height.
  std::vector<std::int32_t> wrong() {
    std::vector<Box<3>> boxes;
    for (const Triangle& t : cut_.triangles) {
      Box<3> box = empty_box<3>();
      for (const std::int32_t v : t) include(box, cut_.vertices[index(v)]);
      boxes.push_back(box);
    }
    const BoxTree<3> tree(boxes);
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(cut_.triangles.size()); ++t) {
      if (!is_new(t)) continue;
      if (is_line(t) || looks_away(t)) add(t);
      if (has_no_area(t)) continue;
      tree.for_meeting(boxes[index(t)], [&](std::int32_t other) {
        if (other == t || has_no_area(other) || (is_new(other) && other < t)) return;
        if (!triangles_meet(corners(t), cut_.triangles[index(t)], corners(other),
                            cut_.triangles[index(other)]))
          return;
        add(t);
        add(other);
      });
    }
    return std::move(wrong_);
  }

 private:
  void add(std::int32_t t) { wrong_.push_back(cut_.origins[index(t)]); }

  bool is_new(std::int32_t t) const {
    const Triangle& v = cut_.triangles[index(t)];
    return std::any_of(v.begin(), v.end(), [&](std::int32_t corner) {
      return corner >= first_new_ || cut_.on_crease[index(corner)] != 0;
    });
  }
  FacetCorners<3> corners(std::int32_t t) const {
    const Triangle& v = cut_.triangles[index(t)];
    return {cut_.vertices[index(v[0])], cut_.vertices[index(v[1])], cut_.vertices[index(v[2])]};
  }
  bool has_no_area(std::int32_t t) const {
    return twice_area(cut_, cut_.triangles[index(t)]) == Point<3>{};
  }

  double squared_longest(std::int32_t t) const {
    const FacetCorners<3> x = corners(t);
    return std::max({squared_distance<3>(x[0], x[1]), squared_distance<3>(x[1], x[2]),
                     squared_distance<3>(x[2], x[0])});
  }
  bool is_line(std::int32_t t) const {
    constexpr double kLeastHeight = 1e-5;  // [resolution]
    return length(twice_area(cut_, cut_.triangles[index(t)])) <=
           kLeastHeight * resolution_ * std::sqrt(squared_longest(t));
  }

  // Returns true if the triangle faces away from the normals at all its vertices off creases. Thin
  // triangles are not judged, because their normals are inaccurate.
  bool looks_away(std::int32_t t) const {
    constexpr double kThin = 0.02;
    const Triangle& v = cut_.triangles[index(t)];
    const Point<3> area = twice_area(cut_, v);
    if (length(area) < kThin * squared_longest(t)) return false;
    int sides = 0, away = 0;
    for (const std::int32_t corner : v)
      if (cut_.on_crease[index(corner)] == 0) {
        ++sides;
        away += dot(area, crossings_.normals[index(corner)]) < 0 ? 1 : 0;
      }
    return sides > 0 && away == sides;
  }

  std::int32_t first_new_;
  const LevelSetCrossings& crossings_;
  const CutSurface& cut_;
  double resolution_;
  std::vector<std::int32_t> wrong_;
};

// ------------------------------------------------------------------ creases --------------------

class CreaseFinder {
 public:
  CreaseFinder(const LevelSet& set, const LevelSetCrossings& crossings, const CutSurface& cut)
      : set_(set), crossings_(crossings), cut_(cut) {}

  // Returns the edges between vertices on creases at which the normal of f turns.
  std::vector<SurfaceCrease> run() {
    constexpr double kTurn = 0.75 * kKinkAngle;  // below kKinkAngle, because sides may be curved
    struct Side {
      std::array<std::int32_t, 2> edge;
      bool backward;
      std::int32_t triangle;
      auto operator<=>(const Side&) const = default;
    };
    std::vector<Side> sides;
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(cut_.triangles.size()); ++t) {
      const Triangle& v = cut_.triangles[index(t)];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t a = v[k], b = v[(k + 1) % 3];
        if (cut_.on_crease[index(a)] != 0 && cut_.on_crease[index(b)] != 0)
          sides.push_back({edge_of(a, b), b < a, t});
      }
    }
    std::sort(sides.begin(), sides.end());
    std::vector<std::int32_t> triangles;
    for (const Side& side : sides) triangles.push_back(side.triangle);
    const std::vector<Point<3>> normals = normals_of(triangles);
    std::vector<SurfaceCrease> creases;
    for (std::size_t k = 1; k < sides.size(); ++k)
      if (sides[k].edge == sides[k - 1].edge && sides[k].backward && !sides[k - 1].backward &&
          !turn_less(normals[k - 1], normals[k], kTurn))
        creases.push_back({sides[k].edge, {normals[k - 1], normals[k]}});
    return creases;
  }

 private:
  // Returns the normal of f on each triangle: at a vertex off all creases, or at the centroid.
  std::vector<Point<3>> normals_of(const std::vector<std::int32_t>& triangles) const {
    std::vector<Point<3>> normals(triangles.size()), middles;
    std::vector<std::size_t> of_middles;
    for (std::size_t k = 0; k < triangles.size(); ++k) {
      const Triangle& v = cut_.triangles[index(triangles[k])];
      Point<3> middle{};
      for (const std::int32_t corner : v) {
        middle = shifted(middle, 1. / 3, cut_.vertices[index(corner)]);
        if (cut_.on_crease[index(corner)] == 0) normals[k] = crossings_.normals[index(corner)];
      }
      if (normals[k] != Point<3>{}) continue;
      of_middles.push_back(k);
      middles.push_back(middle);
    }
    const std::vector<LevelSetSlope> slopes = set_.slopes(middles);
    for (std::size_t k = 0; k < slopes.size(); ++k) normals[of_middles[k]] = slopes[k].normal();
    return normals;
  }

  const LevelSet& set_;
  const LevelSetCrossings& crossings_;
  const CutSurface& cut_;
};

// Raises the care at the vertices of these triangles, and with `widen` also of their neighbours.
void raise_care(const SurfaceSource& surface, const std::vector<std::int32_t>& triangles,
                bool widen, std::vector<char>& care) {
  std::vector<char> wrong(care.size(), 0);
  for (const std::int32_t t : triangles)
    for (const std::int32_t v : surface.triangles[index(t)]) wrong[index(v)] = 1;
  if (widen) {
    const std::vector<char> before = wrong;
    for (const Triangle& t : surface.triangles)
      if (before[index(t[0])] + before[index(t[1])] + before[index(t[2])] > 0)
        for (const std::int32_t v : t) wrong[index(v)] = 1;
  }
  for (std::size_t v = 0; v < care.size(); ++v)
    if (wrong[v] != 0 && care[v] < kLeftAlone) ++care[v];
}

void warn_of_rounded(const LevelSetCrossings& crossings, const std::vector<char>& care,
                     SurfaceSource& surface, const std::string& name) {
  std::int64_t rounded = 0;
  MessageText first;
  for (const CreaseCrossing& edge : crossings.edges)
    if (std::max(care[index(edge.vertices[0])], care[index(edge.vertices[1])]) >= kLeftAlone &&
        rounded++ == 0)
      first = point_text(edge.at.position);
  if (rounded > 0)
    surface.warnings.emplace_back(
        WarningCode::edges_rounded,
        "edges of " + name + " are rounded by the resolution across " + std::to_string(rounded) +
            " of " + std::to_string(crossings.edges.size()) + " triangle edges, the first at " +
            first + ": a smaller resolution helps",
        rounded);
}

// Cuts the surface where no triangles cross as a result. Returns false if this fails.
bool cut_where_it_can_be(const LevelSet& set, std::int32_t first_new,
                         const LevelSetCrossings& crossings, SurfaceSource& surface) {
  constexpr int kMaxRounds = 10, kRoundsBeforeWidening = 3;
  std::vector<char> care(surface.vertices.size(), 0);
  CutSurface cut;
  for (int round = 0;; ++round) {
    if (round == kMaxRounds) return false;
    cut = cut_at_creases(surface, crossings, care, set.resolution());
    const std::vector<std::int32_t> wrong =
        CutCheck(first_new, crossings, cut, set.resolution()).wrong();
    if (wrong.empty()) break;
    raise_care(surface, wrong, round >= kRoundsBeforeWidening || round == 0, care);
  }
  warn_of_rounded(crossings, care, surface, set.name());
  surface.creases = CreaseFinder(set, crossings, cut).run();
  std::vector<std::int32_t> tags;
  for (const std::int32_t origin : cut.origins) tags.push_back(surface.tags[index(origin)]);
  surface.vertices = std::move(cut.vertices);
  surface.triangles = std::move(cut.triangles);
  surface.tags = std::move(tags);
  return true;
}

}  // namespace

void add_creases(const LevelSet& set, SurfaceSource& surface) {
  for (const bool third_sides : {true, false}) {
    SurfaceSource cut = surface;
    const LevelSetCrossings crossings = find_crossings(set, cut, third_sides);
    if (crossings.edges.empty()) return;
    const auto first_new = static_cast<std::int32_t>(surface.vertices.size());
    if (cut_where_it_can_be(set, first_new, crossings, cut)) {
      surface = std::move(cut);
      return;
    }
  }
  surface.warnings.emplace_back(
      WarningCode::edges_rounded,
      "edges of " + set.name() + " are rounded by the resolution: a smaller one may help");
}

}  // namespace pnpbs
