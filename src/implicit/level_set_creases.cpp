// SPDX-License-Identifier: BSD-3-Clause
#include "implicit/level_set_creases.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "base/index.hpp"
#include "base/limits.hpp"
#include "base/point_text.hpp"
#include "base/space_vectors.hpp"
#include "geometry/volume/triangle_contacts.hpp"
#include "implicit/crease_cutting.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

namespace {

using Triangle = std::array<std::int32_t, 3>;

Point<3> twice_area(const CutSurface& cut, const Triangle& t) {
  const Point<3>& a = cut.vertices[index(t[0])];
  return cross(difference(cut.vertices[index(t[1])], a), difference(cut.vertices[index(t[2])], a));
}

// ------------------------------------------------------------------ what is wrong with it ------

class CutCheck {
 public:
  // Of the vertices, those from `first_new` on have come.
  CutCheck(std::int32_t first_new, const LevelSetCrossings& crossings, const CutSurface& cut,
           double resolution)
      : first_new_(first_new), crossings_(crossings), cut_(cut), resolution_(resolution) {}

  // Triangles of the smooth surface out of which such came that look the wrong way, cross, or are
  // lines.
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
    constexpr double kLeastHeight = 1e-5;  // resolutions
    return length(twice_area(cut_, cut_.triangles[index(t)])) <=
           kLeastHeight * resolution_ * std::sqrt(squared_longest(t));
  }

  // From all sides on which it has vertices; of a thin one that says nothing.
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

  // Edges between vertices on creases, across which f turns.
  std::vector<SurfaceCrease> run() {
    constexpr double kTurn = 0.75 * kKinkAngle;  // less than at the edge: sides may bend
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
  // Of f: at a vertex off all creases, or in the middle.
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

// At the vertices of these triangles, and of those around if they are to be widened, more care.
void take_care(const SurfaceSource& surface, const std::vector<std::int32_t>& triangles, bool widen,
               std::vector<char>& care) {
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

// Cuts the surface where that makes no triangles cross; says whether it came about.
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
    take_care(surface, wrong, round >= kRoundsBeforeWidening || round == 0, care);
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
