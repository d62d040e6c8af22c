// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces/nesting.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "base/index.hpp"
#include "base/limits.hpp"
#include "base/space_vectors.hpp"
#include "base/union_find.hpp"
#include "geometry/even_odd.hpp"
#include "geometry/volume/triangles.hpp"
#include "predicates/expansion.hpp"
#include "surfaces/surface_checks.hpp"

namespace pnpbs {
namespace {

// Orders the triangles at an edge by angle around it, counter-clockwise as seen when looking from
// its higher vertex to the lower.
class AroundEdge {
 public:
  AroundEdge(const Triangulation& surface, const std::array<std::int32_t, 2>& ends,
             const EdgeSide& first)
      : surface_(surface),
        a_(surface.vertices[ends[0]]),
        b_(surface.vertices[ends[1]]),
        first_(apex(first)) {}

  bool operator()(const EdgeSide& s, const EdgeSide& t) const {
    const int sector_s = sector(s), sector_t = sector(t);
    if (sector_s != sector_t) return sector_s < sector_t;
    return orientation(a_, b_, apex(s), apex(t)) > 0;
  }

 private:
  const Point<3>& apex(const EdgeSide& side) const {
    return surface_.vertices[surface_.triangles[side.triangle].vertices[(side.k + 2) % 3]];
  }
  // Returns 0 for the first triangle, 1 for angles below half a turn from it, 2 for half a turn,
  // and 3 for more.
  int sector(const EdgeSide& side) const {
    const Point<3>& x = apex(side);
    const int turn = orientation(a_, b_, first_, x);
    if (turn != 0) return turn > 0 ? 1 : 3;
    return &x == &first_ ? 0 : 2;
  }

  const Triangulation& surface_;
  const Point<3>&a_, &b_, &first_;
};

std::int32_t front_of(std::int32_t t) { return 2 * t; }

// Return the side of a triangle that lies ahead of it, or behind it, when going counter-clockwise
// around the edge. The front lies ahead if the triangle has the edge from the lower vertex to the
// higher.
std::int32_t side_ahead(const EdgeSide& side) {
  return front_of(side.triangle) + (side.forward ? 0 : 1);
}
std::int32_t side_behind(const EdgeSide& side) {
  return front_of(side.triangle) + (side.forward ? 1 : 0);
}

// Numbers the sets in the order of their first members.
std::vector<std::int32_t> numbered(UnionFind<std::int32_t>& sets, std::size_t members,
                                   std::int32_t& count) {
  std::vector<std::int32_t> number(members);
  for (std::size_t i = 0; i < members; ++i) {
    const std::int32_t root = sets.root(static_cast<std::int32_t>(i));
    number[i] = root == static_cast<std::int32_t>(i) ? count++ : number[root];
  }
  return number;
}

}  // namespace

SurfaceRegions::SurfaceRegions(const Triangulation& surface, const SurfaceEdges& edges,
                               const BoxTree<3>& tree)
    : surface_(surface), tree_(tree), bounds_(empty_box<3>()) {
  for (const SurfaceTriangle& triangle : surface.triangles)
    for (const std::int32_t v : triangle.vertices) include(bounds_, surface.vertices[v]);
  find_components(edges);
  find_classes(edges);
}

void SurfaceRegions::find_components(const SurfaceEdges& edges) {
  UnionFind<std::int32_t> connected = connected_triangles(surface_, edges);
  component_ = numbered(connected, surface_.triangles.size(), components_);
  first_triangle_.assign(components_, -1);
  for (std::size_t t = 0; t < component_.size(); ++t)
    if (first_triangle_[component_[t]] < 0)
      first_triangle_[component_[t]] = static_cast<std::int32_t>(t);
}

void SurfaceRegions::find_classes(const SurfaceEdges& edges) {
  UnionFind<std::int32_t> classes(2 * surface_.triangles.size());
  std::vector<EdgeSide> sides;
  for (std::size_t e = 0; e < edges.count(); ++e) {
    const auto given = edges.sides(e);
    sides.assign(given.begin(), given.end());
    if (sides.size() > 2)
      std::sort(sides.begin(), sides.end(), AroundEdge(surface_, edges.ends(e), given[0]));
    for (std::size_t s = 0; s < sides.size(); ++s)
      classes.join(side_ahead(sides[s]), side_behind(sides[(s + 1) % sides.size()]));
  }
  std::int32_t count = 0;
  class_of_side_ = numbered(classes, 2 * surface_.triangles.size(), count);
  number_regions(enclosed_volumes(count));
}

// Returns six times the volume that each class encloses; negative for outer classes.
std::vector<double> SurfaceRegions::enclosed_volumes(std::int32_t classes) const {
  std::vector<TwoTerms> sums(classes, TwoTerms{0, 0});
  const auto add = [&sums](std::int32_t c, double term) {
    const TwoTerms next = two_sum(sums[c].high, term);
    sums[c] = {next.high, sums[c].low + next.low};
  };
  for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
    const std::int32_t front = class_of_side_[2 * t], back = class_of_side_[2 * t + 1];
    if (front == back) continue;
    // The origin is a vertex of the component, so that small components far away keep their digits.
    const Point<3>& origin =
        surface_.vertices[surface_.triangles[first_triangle_[component_[t]]].vertices[0]];
    const FacetCorners<3> corners = surface_.corners(static_cast<std::int32_t>(t));
    const double volume =
        dot(difference(corners[0], origin),
            cross(difference(corners[1], origin), difference(corners[2], origin)));
    add(back, volume);
    add(front, -volume);
  }
  std::vector<double> volumes(classes);
  for (std::int32_t c = 0; c < classes; ++c) volumes[c] = sums[c].high + sums[c].low;
  return volumes;
}

void SurfaceRegions::number_regions(const std::vector<double>& volumes) {
  std::vector<std::int32_t> outer(components_, -1);  // the outer class of each component
  for (std::size_t side = 0; side < class_of_side_.size(); ++side) {
    const std::int32_t c = class_of_side_[side];
    std::int32_t& best = outer[component_[side / 2]];
    if (best < 0 || volumes[c] < volumes[best]) best = c;
  }
  volume_ = volumes;
  for (const std::int32_t c : outer) volume_[c] = 0;
  region_.assign(volumes.size(), -1);
  for (const std::int32_t c : outer) region_[c] = 0;
  for (std::int32_t& region : region_)
    if (region < 0) region = count_++;
  outside_.assign(components_, 0);
  if (components_ == 1) return;
  // Component of each vertex; -2 if several have it.
  std::vector<std::int32_t> component_at(surface_.vertices.size(), -1);
  for (std::size_t t = 0; t < surface_.triangles.size(); ++t)
    for (const std::int32_t v : surface_.triangles[t].vertices)
      component_at[v] =
          component_at[v] == -1 || component_at[v] == component_[t] ? component_[t] : -2;
  std::vector<std::int32_t> around(components_);
  for (std::int32_t c = 0; c < components_; ++c)
    around[c] = region_around(point_of(c, component_at), c);
  for (std::int32_t c = 0; c < components_; ++c) region_[outer[c]] = around[c];
  outside_ = std::move(around);
}

// Returns a point of the component that lies on no other: one of its own vertices, or a centroid if
// it shares all its vertices.
Point<3> SurfaceRegions::point_of(std::int32_t component,
                                  const std::vector<std::int32_t>& component_at) const {
  const std::int32_t first = first_triangle_[component];
  for (std::size_t t = first; t < surface_.triangles.size(); ++t) {
    if (component_[t] != component) continue;
    for (const std::int32_t v : surface_.triangles[t].vertices)
      if (component_at[v] == component) return surface_.vertices[v];
  }
  return centroid(surface_.corners(first));
}

// Casts a ray from x. A class encloses x if the ray crosses its sides an odd number of times.
// Components are nested, so the innermost of these classes is the one of smallest volume.
std::int32_t SurfaceRegions::region_around(const Point<3>& x,
                                           std::int32_t without_component) const {
  if (!in_closed_box(bounds_, x)) return 0;
  Point<3> end = x;
  end[0] = bounds_.high[0] + size_of(bounds_);
  std::vector<std::int32_t> crossed;
  tree_.for_meeting({x, end}, [&](std::int32_t t) {
    if (component_[t] == without_component || !crosses(x, end, surface_.corners(t))) return;
    crossed.push_back(class_of_side_[2 * std::size_t(t)]);
    crossed.push_back(class_of_side_[2 * std::size_t(t) + 1]);
  });
  std::sort(crossed.begin(), crossed.end());
  std::int32_t innermost = -1;
  for (std::size_t i = 0; i < crossed.size();) {
    const std::int32_t c = crossed[i];
    std::size_t times = 0;
    for (; i < crossed.size() && crossed[i] == c; ++i) ++times;
    if (times % 2 == 0 || !(volume_[c] > 0)) continue;
    if (innermost < 0 || volume_[c] < volume_[innermost]) innermost = c;
  }
  return innermost < 0 ? 0 : region_[innermost];
}

std::vector<char> inside_by_parity(const Triangulation& surface, const SurfaceRegions& regions) {
  std::vector<RegionContact> contacts;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const auto t = static_cast<std::int32_t>(i);
    const std::int32_t front = regions.front(t), back = regions.back(t);
    if (front != back) contacts.push_back({front, back, !surface.triangles[t].inner});
  }
  return inside_by_parity(index(regions.count()), contacts);
}

void give_roles(Triangulation& surface, const std::map<std::int32_t, SurfaceRole>& roles) {
  if (roles.empty()) return;
  std::set<std::int32_t> met;
  for (SurfaceTriangle& triangle : surface.triangles) {
    const auto role = roles.find(triangle.tag);
    if (role == roles.end()) continue;
    met.insert(triangle.tag);
    triangle.inner = role->second == SurfaceRole::inner;
    triangle.by_place = role->second == SurfaceRole::by_place;
    triangle.dividing = role->second == SurfaceRole::dividing;
  }
  for (const auto& [tag, role] : roles)
    if (!met.contains(tag))
      throw Error(ErrorKind::domain, "no triangle of the surfaces has the tag " +
                                         std::to_string(tag) + ", which was given a role");
}

namespace {

// Determines the roles of the dividing triangles of one source.
void find_roles_of_source(Triangulation& surface, std::int32_t source) {
  Triangulation alone{surface.sources, surface.tag_names, surface.vertices, surface.given, {}};
  std::vector<std::size_t> number;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (surface.triangles[t].source == source) {
      alone.triangles.push_back(surface.triangles[t]);
      number.push_back(t);
    }
  const SurfaceEdges edges(alone);
  const BoxTree<3> tree = tree_of(alone);
  reject_crossings(alone, tree);
  const SurfaceRegions regions(alone, edges, tree);
  for (std::size_t k = 0; k < number.size(); ++k) {
    SurfaceTriangle& triangle = surface.triangles[number[k]];
    const auto t = static_cast<std::int32_t>(k);
    if (triangle.dividing) triangle.inner = regions.front(t) != 0 && regions.back(t) != 0;
  }
}

}  // namespace

void find_roles_of_dividing(Triangulation& surface) {
  std::set<std::int32_t> sources;
  for (const SurfaceTriangle& triangle : surface.triangles)
    if (triangle.dividing) sources.insert(triangle.source);
  for (const std::int32_t source : sources) find_roles_of_source(surface, source);
}

void find_roles_by_location(Triangulation& surface) {
  if (std::ranges::none_of(surface.triangles, &SurfaceTriangle::by_place)) return;
  const SurfaceEdges edges(surface);
  const BoxTree<3> tree = tree_of(surface);
  reject_crossings(surface, tree);
  const SurfaceRegions regions(surface, edges, tree);
  const auto count = static_cast<std::int32_t>(surface.triangles.size());
  for (std::int32_t t = 0; t < count; ++t) {
    SurfaceTriangle& triangle = surface.triangles[static_cast<std::size_t>(t)];
    if (!triangle.by_place) continue;
    const std::int32_t around = regions.outside(regions.component(t));
    triangle.inner = (regions.front(t) == around) == (regions.back(t) == around);
  }
  const std::vector<char> inside = inside_by_parity(surface, regions);
  for (std::int32_t t = 0; t < count; ++t) {
    SurfaceTriangle& triangle = surface.triangles[static_cast<std::size_t>(t)];
    if (triangle.by_place && triangle.inner &&
        !inside[static_cast<std::size_t>(regions.front(t))] &&
        !inside[static_cast<std::size_t>(regions.back(t))])
      triangle.inner = false;
  }
}

}  // namespace pnpbs
