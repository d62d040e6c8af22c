// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces/triangulation.hpp"

#include <algorithm>

#include "base/limits.hpp"
#include "base/point_text.hpp"

namespace pnpbs {

namespace {

std::int32_t number_of(const std::vector<std::int32_t>& numbers, std::size_t i) {
  return numbers.empty() ? static_cast<std::int32_t>(i) : numbers[i];
}

}  // namespace

void add_surface(BoundaryMesh<3>& mesh, SurfaceRole role, std::span<const Point<3>> nodes,
                 std::span<const std::array<std::int32_t, 3>> triangles,
                 std::span<const std::int32_t> tags) {
  const auto first = static_cast<std::int32_t>(mesh.nodes.size());
  for (const Point<3>& x : nodes) mesh.nodes.push_back({x, 0});
  for (std::size_t t = triangles.size(); t-- > 0;)
    for (const std::int32_t corner : triangles[t])
      mesh.nodes[static_cast<std::size_t>(first + corner)].tag = tags[t];
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    BoundaryTriangle facet{triangles[t], tags[t], role == SurfaceRole::inner, true};
    for (std::int32_t& node : facet.nodes) node += first;
    mesh.facets.push_back(facet);
  }
}

FacetCorners<3> Triangulation::corners(std::int32_t t) const {
  const auto& [a, b, c] = triangles[t].vertices;
  return {vertices[a], vertices[b], vertices[c]};
}

Box<3> Triangulation::box(std::int32_t t) const {
  Box<3> box = empty_box<3>();
  for (const Point<3>& x : corners(t)) include(box, x);
  return box;
}

MessageText Triangulation::vertex_name(std::int32_t v) const {
  const GivenVertex& first = given[v];
  if (first.source < 0) return "the intersection at " + point_text(vertices[v]);
  return "vertex " + std::to_string(first.number) + " of " + sources[first.source] + " " +
         point_text(vertices[v]);
}

std::string Triangulation::triangle_name(std::int32_t t) const {
  return "triangle " + std::to_string(triangles[t].number) + " of " + group_name(t);
}

std::string Triangulation::group_name(std::int32_t t) const {
  const SurfaceTriangle& triangle = triangles[t];
  const TagNameList& names = tag_names[triangle.source];
  const auto name = std::ranges::find(names, triangle.tag, &TagNameList::value_type::first);
  return sources[triangle.source] + (name == names.end() ? "" : " '" + name->second + "'");
}

Triangulation join_surfaces(const std::vector<SurfaceSource>& surfaces) {
  Triangulation all;
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    const SurfaceSource& surface = surfaces[s];
    const auto source = static_cast<std::int32_t>(s);
    const auto first = static_cast<std::int32_t>(all.vertices.size());
    all.sources.push_back(surface.name);
    all.tag_names.push_back(surface.tag_names);
    for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
      all.vertices.push_back(surface.vertices[v]);
      all.given.push_back({source, number_of(surface.vertex_numbers, v)});
    }
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      const auto& [a, b, c] = surface.triangles[t];
      all.triangles.push_back({{first + a, first + b, first + c},
                               surface.tags[t],
                               source,
                               number_of(surface.triangle_numbers, t),
                               surface.role == SurfaceRole::inner,
                               surface.role == SurfaceRole::by_place,
                               surface.role == SurfaceRole::dividing});
    }
  }
  return all;
}

}  // namespace pnpbs
