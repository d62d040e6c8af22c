// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces/thin_triangles.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>

#include "base/error.hpp"
#include "base/point_text.hpp"
#include "base/space_vectors.hpp"

namespace pnpbs {

namespace {

bool is_collapsed(const SurfaceTriangle& triangle) {
  const auto& [a, b, c] = triangle.vertices;
  return a == b || b == c || c == a;
}

// Returns the corner opposite the longest edge; the first if there are several.
int apex_of(const FacetCorners<3>& corners) {
  int apex = 0;
  double longest = 0;
  for (int k = 0; k < 3; ++k) {
    const double edge = distance<3>(corners[(k + 1) % 3], corners[(k + 2) % 3]);
    if (edge > longest) apex = k, longest = edge;
  }
  return apex;
}

double longest_edge(const FacetCorners<3>& corners) {
  const int apex = apex_of(corners);
  return distance<3>(corners[(apex + 1) % 3], corners[(apex + 2) % 3]);
}

// Limits below which triangles are flat by rounding. Coordinates in single precision have errors of
// a millionth of the domain's size.
constexpr double kRounding = 1000;    // height [tolerance]
constexpr double kFlatHeight = 1e-4;  // height [shorter of the two other edges]

// The triangles that are removed beside those without area.
enum class Thin { within_tolerance, flat_by_rounding };

bool is_thin(const FacetCorners<3>& corners, double tolerance, Thin thin) {
  const double longest = longest_edge(corners);
  const double twice_area =
      length(cross(difference(corners[1], corners[0]), difference(corners[2], corners[0])));
  const double height = longest == 0 ? 0 : twice_area / longest;
  if (height <= tolerance) return true;
  if (thin == Thin::within_tolerance) return false;
  const int k = apex_of(corners);
  const double shorter = std::min(distance<3>(corners[k], corners[(k + 1) % 3]),
                                  distance<3>(corners[k], corners[(k + 2) % 3]));
  return height <= kRounding * tolerance && height <= kFlatHeight * shorter;
}

// Number of cuts after which short edges are collapsed, far more than needed elsewhere.
constexpr std::size_t kMaxCuts = 10;  // per thin triangle
constexpr std::size_t kFewThin = 1000;
// The length below which edges are collapsed grows by this factor after that many cuts, up to the
// largest length. [tolerance]
constexpr double kCollapseStep = 4;
constexpr double kLongestCollapsed = 1024;

class Thinner {
 public:
  Thinner(Triangulation& surface, double tolerance, Thin thin)
      : surface_(surface), triangles_(surface.triangles), tolerance_(tolerance), removes_(thin) {}

  // Returns a triangle that is still too thin if the cuts do not end. At a short edge between two
  // long ones, cutting along one diagonal of the four vertices can create the other one again and
  // again. Then such edges are collapsed, the shortest first.
  std::optional<std::int32_t> run() {
    const std::size_t given = triangles_.size();
    for (std::size_t t = 0; t < given; ++t) look_at(static_cast<std::int32_t>(t));
    if (removed_ == 0 && thin_.empty()) return std::nullopt;
    list_triangles_at_vertices();
    // The longest come first, because cutting a triangle along its long edge shortens its pieces.
    const std::size_t most_cuts = kMaxCuts * std::max(thin_.size(), kFewThin);
    for (std::size_t cuts = 1; !thin_.empty(); ++cuts) {
      const std::int32_t t = std::get<1>(thin_.top());
      thin_.pop();
      if (!gone_[t] && !(collapsed_below_ > 0 && is_repaired_by_collapse(t))) cut_out(t);
      if (cuts % most_cuts != 0) continue;
      if (removes_ == Thin::flat_by_rounding || collapsed_below_ >= kLongestCollapsed * tolerance_)
        return t;
      collapsed_below_ = kCollapseStep * std::max(collapsed_below_, tolerance_);
    }
    std::size_t kept = 0;
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      if (!gone_[t]) triangles_[kept++] = triangles_[t];
    triangles_.resize(kept);
    return std::nullopt;
  }

  std::int64_t removed() const { return removed_; }
  // Returns the vertices that were merged, each with the one that stays, in the order of merging.
  const std::vector<std::array<std::int32_t, 2>>& merged() const { return merged_; }
  // Returns the name and the location of the first removed triangle.
  const MessageText& first_removed() const { return first_name_; }

 private:
  void look_at(std::int32_t t) {
    gone_.resize(triangles_.size(), 0);
    if (is_collapsed(triangles_[t])) {
      remove(t);
    } else if (is_thin(surface_.corners(t), tolerance_, removes_)) {
      thin_.push({longest_edge(surface_.corners(t)), t});
    }
  }

  void remove(std::int32_t t) {
    gone_[t] = 1;
    ++removed_;
    const auto first = std::pair(triangles_[t].source, triangles_[t].number);
    if (!first_name_.empty() && first > first_) return;
    first_ = first;
    first_name_ = surface_.triangle_name(t) + " at " +
                  point_text(surface_.vertices[triangles_[t].vertices[0]]);
  }

  void list_triangles_at_vertices() {
    at_vertex_.resize(surface_.vertices.size());
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      if (!gone_[t]) list(static_cast<std::int32_t>(t));
  }
  void list(std::int32_t t) {
    for (const std::int32_t v : triangles_[t].vertices) at_vertex_[v].push_back(t);
  }

  void cut_out(std::int32_t t) {
    const int k = apex_of(surface_.corners(t));
    const auto& corners = triangles_[t].vertices;
    const std::int32_t apex = corners[k], a = corners[(k + 1) % 3], b = corners[(k + 2) % 3];
    remove(t);
    std::erase_if(at_vertex_[a], [this](std::int32_t other) { return gone_[other] != 0; });
    const std::vector<std::int32_t> at_a = at_vertex_[a];
    for (const std::int32_t other : at_a) {
      if (gone_[other] || !triangles_[other].has(b)) continue;
      gone_[other] = 1;
      for (const std::int32_t end : {b, a}) {
        SurfaceTriangle piece = triangles_[other];
        std::replace(piece.vertices.begin(), piece.vertices.end(), end, apex);
        if (is_collapsed(piece)) continue;
        triangles_.push_back(piece);
        const auto added = static_cast<std::int32_t>(triangles_.size()) - 1;
        look_at(added);
        list(added);
      }
    }
  }

  // Merges the ends of the shortest edge, the higher vertex into the lower, if it is short enough.
  // Returns false if it is not. Returns true also if the triangle is no longer thin because a
  // vertex was merged before.
  bool is_repaired_by_collapse(std::int32_t t) {
    if (!is_thin(surface_.corners(t), tolerance_, removes_)) return true;
    const std::array<std::int32_t, 3> vertices = triangles_[t].vertices;
    std::int32_t stays = -1, goes = -1;
    double shortest = collapsed_below_;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(vertices[k], vertices[(k + 1) % 3]);
      const double edge = distance<3>(surface_.vertices[low], surface_.vertices[high]);
      if (edge > shortest) continue;
      shortest = edge;
      stays = low;
      goes = high;
    }
    if (goes < 0) return false;
    const std::vector<std::int32_t> moved = std::move(at_vertex_[goes]);
    at_vertex_[goes].clear();
    for (const std::int32_t other : moved) {
      if (gone_[other]) continue;
      std::replace(triangles_[other].vertices.begin(), triangles_[other].vertices.end(), goes,
                   stays);
      look_at(other);
      if (!gone_[other]) at_vertex_[stays].push_back(other);
    }
    merged_.push_back({goes, stays});
    return true;
  }

  Triangulation& surface_;
  std::vector<SurfaceTriangle>& triangles_;
  double tolerance_;
  Thin removes_;
  double collapsed_below_ = 0;
  std::vector<char> gone_;
  std::priority_queue<std::pair<double, std::int32_t>> thin_;
  std::vector<std::vector<std::int32_t>> at_vertex_;
  std::vector<std::array<std::int32_t, 2>> merged_;
  std::int64_t removed_ = 0;
  std::pair<std::int32_t, std::int32_t> first_{};
  MessageText first_name_;
};

}  // namespace

void remove_thin_triangles(Triangulation& surface, double tolerance,
                           std::vector<Warning>& warnings) {
  Thinner thinner(surface, tolerance, Thin::flat_by_rounding);
  if (const auto t = thinner.run()) throw BrokenSurface(surface.triangle_name(*t) + " is too thin");
  const std::int64_t count = thinner.removed();
  if (count == 0) return;
  warnings.emplace_back(WarningCode::triangles_left_out,
                        std::to_string(count) + (count == 1 ? " triangle has" : " triangles have") +
                            " a negligible area and " + (count == 1 ? "is" : "are") +
                            " left out; the first is " + thinner.first_removed(),
                        count);
}

std::optional<std::int32_t> remove_thin_pieces(Triangulation& surface, double tolerance,
                                               std::vector<std::array<std::int32_t, 2>>& merged) {
  Thinner thinner(surface, tolerance, Thin::within_tolerance);
  const std::optional<std::int32_t> thin = thinner.run();
  merged = thinner.merged();
  return thin;
}

void remove_duplicate_triangles(Triangulation& surface, std::vector<Warning>& warnings) {
  std::vector<SurfaceTriangle>& triangles = surface.triangles;
  const auto sorted = [&](std::int32_t t) {
    std::array<std::int32_t, 3> vertices = triangles[t].vertices;
    std::sort(vertices.begin(), vertices.end());
    return vertices;
  };
  std::vector<std::pair<std::array<std::int32_t, 3>, std::int32_t>> order;
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(triangles.size()); ++t)
    order.push_back({sorted(t), t});
  std::sort(order.begin(), order.end());
  // Pairs of triangles with the same vertices: a later one, and the first, which stays.
  std::vector<std::pair<std::int32_t, std::int32_t>> doubles;
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (order[i].first != order[i - 1].first) continue;
    const bool third = !doubles.empty() && doubles.back().first == order[i - 1].second;
    doubles.push_back({order[i].second, third ? doubles.back().second : order[i - 1].second});
  }
  if (doubles.empty()) return;
  std::sort(doubles.begin(), doubles.end());
  for (const auto& [later, first] : doubles)
    if (triangles[later].source != triangles[first].source)
      throw BrokenSurface(surface.triangle_name(first) + " and " + surface.triangle_name(later) +
                          " lie on each other at " +
                          point_text(surface.vertices[triangles[first].vertices[0]]));
  const auto& [later, first] = doubles.front();
  warnings.emplace_back(
      WarningCode::triangles_left_out,
      std::to_string(doubles.size()) + (doubles.size() == 1 ? " triangle is" : " triangles are") +
          " given twice and left out; the first is " + surface.triangle_name(later) +
          ", which has the corners of triangle " + std::to_string(triangles[first].number),
      std::ssize(doubles));
  std::vector<char> gone(triangles.size(), 0);
  for (const auto& [t, stays] : doubles) gone[t] = 1;
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (!gone[t]) triangles[kept++] = triangles[t];
  triangles.resize(kept);
}

}  // namespace pnpbs
