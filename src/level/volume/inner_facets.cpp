// SPDX-License-Identifier: BSD-3-Clause
#include "level/volume/inner_facets.hpp"

#include <algorithm>
#include <utility>

#include "base/fixed_point.hpp"
#include "base/limits.hpp"
#include "base/space_vectors.hpp"
#include "delaunay/volume/element_rule.hpp"
#include "geometry/volume/triangles.hpp"
#include "level/volume/settled_elements.hpp"

namespace pnpbs {

namespace {

bool is_inner_triangle(const BoundaryTriangle& facet) {
  const auto& [a, b, c] = facet.nodes;
  return facet.front_inside && facet.back_inside && a != b && b != c && c != a;
}

}  // namespace

bool is_far_from_facets(const Level<3>& level, std::int64_t i) {
  const Nodes<3>& nodes = level.nodes;
  if (nodes.carrier(i) != Carrier::free || nodes.moving != Carrier::free) return false;
  const double room = level.neighbourhood.near_boundary().room(i, nodes);
  bool far = true;
  level.stars.for_neighbours(i, [&](std::int64_t j) {
    far = far && distance<3>(nodes.position(i), nodes.position(j)) < room;
  });
  return far;
}

InnerFacets::InnerFacets(const Level<3>& level)
    : level_(level), any_(level.geometry.has_inner_surfaces()) {}

double InnerFacets::covered_share() {
  if (!any_) return 1;
  const Nodes<3>& nodes = level_.nodes;
  const double size = size_of(level_.geometry.bounds());
  FixedPointSum covered, all;
  const auto area_of = [&](const InnerFacet& facet) {
    const auto& [a, b, c] = facet.nodes;
    return length(area_normal({nodes.position(a), nodes.position(b), nodes.position(c)})) /
           (size * size);
  };
  collective_try(*level_.comm, [&] {
    for (std::int64_t i = 0; i < nodes.count; ++i) {
      if (!nodes.owned(i)) continue;
      for (const InnerFacet& facet : at(i)) covered.add(area_of(facet));
      for (const InnerFacet& facet : strays_at(i)) all.add(area_of(facet));
    }
  });
  all.add(covered);
  const double sum = level_.comm->allreduce_sum(all).value();
  return sum > 0 ? level_.comm->allreduce_sum(covered).value() / sum : 1;
}

const std::vector<InnerFacet>& InnerFacets::at(std::int64_t i) {
  found_.clear();
  if (any_ && is_held(i))
    judge_faces(i, Of::smallest_id, [&](std::int64_t j) { return is_held(j); });
  return found_;
}

const std::vector<InnerFacet>& InnerFacets::around(std::int64_t i) {
  found_.clear();
  if (any_ && is_held(i)) judge_faces(i, Of::all_nodes, [&](std::int64_t j) { return is_held(j); });
  return found_;
}

const std::vector<InnerFacet>& InnerFacets::strays_at(std::int64_t i) {
  strays_.clear();
  if (any_ && !is_far_from_facets(level_, i))
    judge_faces(i, Of::smallest_id, [](std::int64_t) { return true; });
  return strays_;
}

// Judges the faces of node i whose other nodes are wanted: all, or those of which it has the
// smallest id.
template <class Wanted>
void InnerFacets::judge_faces(std::int64_t i, Of of, const Wanted& wanted) {
  const Nodes<3>& nodes = level_.nodes;
  faces_.clear();
  found_.clear();
  strays_.clear();
  level_.stars.for_simplices(i, [&](const Stars<3>::Corners& others) {
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<std::int64_t, 3> face{i, others[k], others[(k + 1) % 3]};
      const std::int64_t apex = others[(k + 2) % 3];
      if (!wanted(face[1]) || !wanted(face[2])) continue;
      std::ranges::sort(face, {}, [&](std::int64_t j) { return nodes.id(j); });
      if (of == Of::smallest_id && face[0] != i) continue;
      const auto& [a, b, c] = face;
      faces_.push_back({{nodes.id(a), nodes.id(b), nodes.id(c)}, face, apex, nodes.id(apex)});
    }
  });
  std::ranges::sort(faces_, {}, [](const Face& f) { return std::pair(f.ids, f.apex_id); });
  for (std::size_t f = 1; f < faces_.size(); ++f)
    if (faces_[f - 1].ids == faces_[f].ids) judge(faces_[f - 1], faces_[f]);
}

Point<3> InnerFacets::centroid_of(const Face& face) const {
  const auto& [a, b, c] = face.nodes;
  return centroid(ordered_by_id(tetrahedron_of(level_.nodes, {a, b, c, face.apex})));
}

void InnerFacets::judge(const Face& one, const Face& other) {
  find_crossed_facets(centroid_of(one), centroid_of(other));
  if (crossed_.empty()) return;
  const LevelGeometry<3>& geometry = level_.geometry;
  const auto holds_all = [&](std::int32_t f) {
    return std::ranges::all_of(
        one.nodes, [&](std::int64_t i) { return on_patch(i, geometry.surface().patch(f)); });
  };
  const auto own = std::ranges::find_if(crossed_, holds_all);
  const std::int32_t f = own != crossed_.end() ? *own : crossed_.front();
  const BoundaryTriangle& facet = geometry.boundary().facets[static_cast<std::size_t>(f)];
  InnerFacet found{one.nodes, facet.tag, f};
  const Nodes<3>& nodes = level_.nodes;
  const Point<3> x = nodes.position(found.nodes[0]);
  const Point<3> normal = cross(difference(nodes.position(found.nodes[1]), x),
                                difference(nodes.position(found.nodes[2]), x));
  if (dot(normal, facet_normal(geometry.boundary(), facet)) < 0)
    std::swap(found.nodes[1], found.nodes[2]);
  if (own != crossed_.end())
    found_.push_back(found);
  else if (!lies_along_surface(level_, one.nodes))
    strays_.push_back(found);
}

bool InnerFacets::on_patch(std::int64_t i, std::int32_t patch) const {
  if (!is_held(i)) return false;
  bool there = false;
  level_.geometry.surface().for_sides(
      level_.geometry.place(level_.nodes.carrier(i), level_.nodes.boundary_node(i)),
      [&](const SurfaceSide& side) { there = there || side.patch == patch; });
  return there;
}

// Finds the facets of the inner surfaces that the segment crosses, in ascending order. Finds none
// if it ends on the side of these surfaces on which it begins.
void InnerFacets::find_crossed_facets(const Point<3>& from, const Point<3>& to) {
  const FacetIndex<3>& sides = level_.geometry.domain().index().sides();
  const Point<3> middle = middle_of<3>(from, to);
  constexpr double kRounding = 1 + 1e-9;
  crossed_.clear();
  sides.for_facets_near(middle, 0.5 * kRounding * distance<3>(from, to), [&](std::int32_t f) {
    if (is_inner_triangle(sides.facet(f)) && crosses(from, to, sides.corners(f)))
      crossed_.push_back(f);
  });
  if (crossed_.empty()) return;
  std::ranges::sort(crossed_);  // the index may report a facet more than once
  crossed_.erase(std::unique(crossed_.begin(), crossed_.end()), crossed_.end());
  if (crossed_.size() % 2 == 0 && !changes_region(from, to)) crossed_.clear();
}

// Returns whether the segment leads into a region with another tag through the crossed facets.
bool InnerFacets::changes_region(const Point<3>& from, const Point<3>& to) const {
  const RegionIndex<3>* regions = level_.geometry.domain().regions();
  if (!regions) return false;
  const auto along = [&](std::int32_t f) {
    const FacetCorners<3>& corners = regions->facet(f).corners;
    const Point<3> normal = area_normal(corners);
    return dot(normal, difference(corners[0], from)) / dot(normal, difference(to, from));
  };
  // Returns the tag on the side of the facet on which x lies.
  const auto tag_at = [&](std::int32_t f, const Point<3>& x) {
    const auto& [corners, inside, tags] = regions->facet(f);
    return tags[dot(area_normal(corners), difference(x, corners[0])) > 0 ? 0 : 1];
  };
  const auto [first, last] = std::ranges::minmax_element(crossed_, {}, along);
  return tag_at(*first, from) != tag_at(*last, to);
}

}  // namespace pnpbs
