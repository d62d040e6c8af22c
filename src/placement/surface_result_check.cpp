// SPDX-License-Identifier: BSD-3-Clause
// The check of the results on surfaces alone.
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include "base/mixed_hash.hpp"
#include "base/space_vectors.hpp"
#include "comm/records.hpp"
#include "placement/result_check.hpp"
#include "placement/volume_node_check.hpp"

namespace pnpbs {

namespace {

struct SentTriangle {
  std::int64_t of, next, last;  // ids: the star of `of` must have the other two, in this order
  std::int64_t owner;           // of `of`
};

// An edge of a triangle, as that turns.
struct TriangleEdge {
  std::int64_t low, high;  // ids
  std::int64_t forward;    // 1 from low to high, 0 back
  std::int64_t sheets;     // of the surfaces that meet there; 0: it is no part of a feature
  Point<3> middle;
};

class SurfaceResultCheck : public VolumeNodeCheck {
 public:
  explicit SurfaceResultCheck(const PlacementOf<3>& placement) : VolumeNodeCheck(placement) {}

  void check() const {
    check_nodes_and_lists();
    check_stars();
    check_edges();
    check_area();
  }

 private:
  using Others = std::array<std::int32_t, 2>;

  bool star_has(std::int64_t i, std::int64_t next, std::int64_t last) const;
  void check_stars() const;
  void check_corner(std::int64_t corner, std::int64_t next, std::int64_t last,
                    std::vector<SentTriangle>& elsewhere) const;
  [[noreturn]] void fail_of_star(const std::string& of, std::int64_t next, std::int64_t last) const;

  std::int64_t sheets_at(std::int64_t i, std::int64_t j) const;
  std::vector<TriangleEdge> edges_by_ends() const;
  void check_edges() const;

  double missed_beside(const std::array<Point<3>, 3>& corners) const;
  double missed_at_feature(const Point<3>& a, const Point<3>& b) const;
  void check_area() const;
};

// ------------------------------------------------------------------ stars ----------------------

bool SurfaceResultCheck::star_has(std::int64_t i, std::int64_t next, std::int64_t last) const {
  bool found = false;
  level_.stars.for_triangles(i, [&](const Others& others) {
    found = found || (nodes_.id(others[0]) == next && nodes_.id(others[1]) == last);
  });
  return found;
}

void SurfaceResultCheck::fail_of_star(const std::string& of, std::int64_t next,
                                      std::int64_t last) const {
  fail_check("the star of node " + of + " lacks the triangle with nodes " + std::to_string(next) +
             " and " + std::to_string(last));
}

void SurfaceResultCheck::check_corner(std::int64_t corner, std::int64_t next, std::int64_t last,
                                      std::vector<SentTriangle>& elsewhere) const {
  if (!nodes_.owned(corner))
    elsewhere.push_back({nodes_.id(corner), nodes_.id(next), nodes_.id(last), owner_of(corner)});
  else if (!star_has(corner, nodes_.id(next), nodes_.id(last)))
    fail_of_star(name(corner), nodes_.id(next), nodes_.id(last));
}

void SurfaceResultCheck::check_stars() const {
  std::vector<SentTriangle> elsewhere;
  for_owned([&](std::int64_t i) {
    bool any = false;
    level_.stars.for_triangles(i, [&](const Others& others) {
      any = true;
      check_corner(others[0], others[1], i, elsewhere);
      check_corner(others[1], i, others[0], elsewhere);
    });
    if (!any) fail_check("node " + name(i) + " lies on a surface, but no triangle has it");
  });
  if (comm_.size() == 1) return;
  for (const SentTriangle& t : redistribute(comm_, elsewhere, [](const SentTriangle& sent) {
         return static_cast<int>(sent.owner);
       })) {
    const std::int64_t i = owned_node(t.of);
    if (i < 0 || !star_has(i, t.next, t.last))
      fail_of_star(i < 0 ? std::to_string(t.of) : name(i), t.next, t.last);
  }
}

// ------------------------------------------------------------------ edges ----------------------

// Of the feature curve on which two nodes are next to each other; 0 if there is none.
std::int64_t SurfaceResultCheck::sheets_at(std::int64_t i, std::int64_t j) const {
  if (!is_feature_node(i) || !is_feature_node(j)) return 0;
  const FeatureNodes& features = ground_.features();
  const std::int32_t a = nodes_.boundary_node(i), b = nodes_.boundary_node(j);
  if (!features.joined(a, b)) return 0;
  const auto curve_of = [&](std::int32_t n) {
    return features.nodes[static_cast<std::size_t>(n)].curve;
  };
  std::int32_t curve = std::max(curve_of(a), curve_of(b));
  for (std::size_t c = 0; curve < 0; ++c) {
    const std::vector<std::int32_t>& row = features.along[c];
    if (row.size() == 2 && std::minmax(row[0], row[1]) == std::minmax(a, b))
      curve = static_cast<std::int32_t>(c);
  }
  const Surface& surface = ground_.surface();
  const FeatureCurve& along = surface.features().curves[static_cast<std::size_t>(curve)];
  return std::ranges::count_if(along.facets.front(),
                               [&](std::int32_t f) { return surface.patch(f) >= 0; });
}

// Those of an edge at one rank.
std::vector<TriangleEdge> SurfaceResultCheck::edges_by_ends() const {
  std::vector<TriangleEdge> edges;
  p_.for_open_facets([&](const Three& places) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t i = p_.node_at(places[k]), j = p_.node_at(places[(k + 1) % 3]);
      TriangleEdge edge{nodes_.id(i), nodes_.id(j), 1, sheets_at(i, j), position(i)};
      for (std::size_t axis = 0; axis < 3; ++axis)
        edge.middle[axis] += (nodes_.x[axis](j) - edge.middle[axis]) / 2;
      if (edge.low > edge.high) {
        std::swap(edge.low, edge.high);
        edge.forward = 0;
      }
      edges.push_back(edge);
    }
  });
  if (comm_.size() > 1)
    edges = redistribute(comm_, edges, [this](const TriangleEdge& edge) {
      const std::uint64_t key =
          mixed(static_cast<std::uint64_t>(edge.low)) ^ static_cast<std::uint64_t>(edge.high);
      return static_cast<int>(mixed(key) % static_cast<std::uint64_t>(comm_.size()));
    });
  std::ranges::sort(edges, {},
                    [](const TriangleEdge& edge) { return std::tuple(edge.low, edge.high); });
  return edges;
}

void SurfaceResultCheck::check_edges() const {
  const std::vector<TriangleEdge> edges = edges_by_ends();
  for (auto edge = edges.begin(); edge != edges.end();) {
    std::int64_t forward = 0, all = 0;
    auto next = edge;
    for (; next != edges.end() && next->low == edge->low && next->high == edge->high; ++next) {
      forward += next->forward;
      ++all;
    }
    const std::int64_t sheets = edge->sheets == 0 ? 2 : edge->sheets;
    if (all != sheets || (edge->sheets == 0 && forward != 1))
      fail_check("the edge of nodes " + std::to_string(edge->low) + " and " +
                 std::to_string(edge->high) + " around " + point_text(edge->middle) + " has " +
                 std::to_string(all) + " triangles, " + std::to_string(forward) +
                 " of them on its left; expected " + std::to_string(sheets));
    edge = next;
  }
}

// ------------------------------------------------------------------ area -----------------------

// What a surface that rises that far from a triangle, and sinks to its corners, may have more of
// area than that.
double SurfaceResultCheck::missed_beside(const std::array<Point<3>, 3>& corners) const {
  constexpr double kSafe = 16;  // eight for a dome
  const auto [a, b, c] = corners;
  const Point<3> normal = cross(difference(b, a), difference(c, a));
  const double twice_area = std::sqrt(dot(normal, normal));
  const double longest = std::max({distance<3>(a, b), distance<3>(b, c), distance<3>(c, a)});
  const double rise = max_gap(corners) * longest / twice_area;  // over the least height
  return 0.5 * twice_area * std::min(kSafe * rise * rise, 1.0);
}

// What lies between a border and an edge that follows it.
double SurfaceResultCheck::missed_at_feature(const Point<3>& a, const Point<3>& b) const {
  const Point<3> middle{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
  const double length = distance<3>(a, b);
  const NearestPoint<3> nearest =
      ground_.domain().index().nearest(middle, std::numeric_limits<double>::infinity());
  if (ground_.surface().patch(nearest.facet) < 0) return 0;
  return 2 * length * ground_.surface().feature_clearance({nearest.facet, nearest.x}, length);
}

void SurfaceResultCheck::check_area() const {
  constexpr double kRounding = 1e-9;
  double area = 0, missed = 0;
  p_.for_open_facets([&](const Three& places) {
    const std::array<Point<3>, 3> x = positions_at(places);
    const Point<3> normal = cross(difference(x[1], x[0]), difference(x[2], x[0]));
    area += 0.5 * std::sqrt(dot(normal, normal));
    missed += missed_beside(x);
    for (std::size_t k = 0; k < 3; ++k)
      if (sheets_at(p_.node_at(places[k]), p_.node_at(places[(k + 1) % 3])) == 1)
        missed += missed_at_feature(x[k], x[(k + 1) % 3]);
  });
  const double unit = ground_.domain().area();
  area = sum_over_ranks(area, unit);
  missed = sum_over_ranks(missed, unit);
  if (std::fabs(area - unit) > kRounding * unit + missed)
    fail_check("the triangles have the area " + number_text(area) + ", the surfaces " +
               number_text(unit) + ", and no more than " + rounded_text(missed) +
               " lies between them");
}

}  // namespace

void check_surfaces(const PlacementOf<3>& placement) { SurfaceResultCheck(placement).check(); }

}  // namespace pnpbs
