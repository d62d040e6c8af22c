// SPDX-License-Identifier: BSD-3-Clause
#include "results/inner_facets.hpp"

#include <algorithm>
#include <utility>

#include "base/fixed_point.hpp"
#include "base/space_vectors.hpp"
#include "delaunay/volume/element_rule.hpp"
#include "geometry/volume/triangles.hpp"

namespace pnpbs {

namespace {

bool is_inner_triangle(const BoundaryTriangle& facet) {
  const auto& [a, b, c] = facet.nodes;
  return facet.front_inside && facet.back_inside && a != b && b != c && c != a;
}

}  // namespace

InnerFacets::InnerFacets(const Level<3>& level)
    : level_(level), any_(level.geometry.has_inner_surfaces()) {}

double InnerFacets::covered_share() {
  const FacetIndex<3>& sides = level_.geometry.domain().index().sides();
  const auto facets = static_cast<std::int32_t>(level_.geometry.boundary().facets.size());
  double area = 0;
  for (std::int32_t f = 0; f < facets; ++f)
    if (is_inner_triangle(sides.facet(f))) area += length(area_normal(sides.corners(f)));
  const Nodes<3>& nodes = level_.nodes;
  FixedPointSum share;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    if (!nodes.owned(i)) continue;
    for (const InnerFacet& facet : at(i)) {
      const auto& [a, b, c] = facet.nodes;
      share.add(length(area_normal({nodes.position(a), nodes.position(b), nodes.position(c)})) /
                area);
    }
  }
  return level_.comm->allreduce_sum(share).value();
}

const std::vector<InnerFacet>& InnerFacets::at(std::int64_t i) { return find(i, true); }

const std::vector<InnerFacet>& InnerFacets::around(std::int64_t i) { return find(i, false); }

const std::vector<InnerFacet>& InnerFacets::find(std::int64_t i, bool least_only) {
  const Nodes<3>& nodes = level_.nodes;
  const auto on_surface = [&](std::int64_t j) { return nodes.carrier(j) != Carrier::free; };
  found_.clear();
  if (!any_ || !on_surface(i)) return found_;
  faces_.clear();
  level_.stars.for_simplices(i, [&](const Stars<3>::Corners& others) {
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<std::int64_t, 3> face{i, others[k], others[(k + 1) % 3]};
      const std::int64_t apex = others[(k + 2) % 3];
      if (!on_surface(face[1]) || !on_surface(face[2])) continue;
      std::ranges::sort(face, {}, [&](std::int64_t j) { return nodes.id(j); });
      if (least_only && face[0] != i) continue;
      const auto& [a, b, c] = face;
      faces_.push_back({{nodes.id(a), nodes.id(b), nodes.id(c)},
                        face,
                        nodes.id(apex),
                        centroid(ordered_by_id(tetrahedron_of(nodes, {a, b, c, apex})))});
    }
  });
  std::ranges::sort(faces_, {}, [](const Face& f) { return std::pair(f.ids, f.apex); });
  for (std::size_t f = 1; f < faces_.size(); ++f)
    if (faces_[f - 1].ids == faces_[f].ids) judge(faces_[f - 1], faces_[f]);
  return found_;
}

void InnerFacets::judge(const Face& one, const Face& other) {
  const std::int32_t f = crossed_facet(one.centroid, other.centroid);
  if (f < 0) return;
  const LevelGeometry<3>& geometry = level_.geometry;
  const std::int32_t patch = geometry.domain().features().patch[static_cast<std::size_t>(f)];
  for (const std::int64_t i : one.nodes)
    if (!on_patch(i, patch)) return;
  const BoundaryTriangle& facet = geometry.boundary().facets[static_cast<std::size_t>(f)];
  InnerFacet found{one.nodes, facet.tag};
  const Nodes<3>& nodes = level_.nodes;
  const Point<3> x = nodes.position(found.nodes[0]);
  const Point<3> normal = cross(difference(nodes.position(found.nodes[1]), x),
                                difference(nodes.position(found.nodes[2]), x));
  if (dot(normal, facet_normal(geometry.boundary(), facet)) < 0)
    std::swap(found.nodes[1], found.nodes[2]);
  found_.push_back(found);
}

bool InnerFacets::on_patch(std::int64_t i, std::int32_t patch) const {
  bool there = false;
  level_.geometry.surface().for_sides(
      level_.geometry.place(level_.nodes.carrier(i), level_.nodes.boundary_node(i)),
      [&](const SurfaceSide& side) { there = there || side.patch == patch; });
  return there;
}

// Returns the first facet of the inner surfaces that the segment crosses if it crosses an odd
// number of them, and -1 otherwise.
std::int32_t InnerFacets::crossed_facet(const Point<3>& from, const Point<3>& to) {
  const FacetIndex<3>& sides = level_.geometry.domain().index().sides();
  const Point<3> middle = middle_of<3>(from, to);
  constexpr double kRounding = 1 + 1e-9;
  crossed_.clear();
  sides.for_facets_near(middle, 0.5 * kRounding * distance<3>(from, to), [&](std::int32_t f) {
    if (is_inner_triangle(sides.facet(f)) && crosses(from, to, sides.corners(f)))
      crossed_.push_back(f);
  });
  std::ranges::sort(crossed_);  // the index may report a facet more than once
  crossed_.erase(std::unique(crossed_.begin(), crossed_.end()), crossed_.end());
  return crossed_.size() % 2 == 1 ? crossed_.front() : -1;
}

}  // namespace pnpbs
