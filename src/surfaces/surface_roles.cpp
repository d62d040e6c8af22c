// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces/surface_roles.hpp"

#include <algorithm>
#include <set>

#include "base/error.hpp"
#include "surfaces/nesting.hpp"
#include "surfaces/self_intersections.hpp"

namespace pnpbs {

void give_roles(Triangulation& surface, const std::map<std::int32_t, SurfaceRole>& roles) {
  if (roles.empty()) return;
  std::set<std::int32_t> met;
  for (SurfaceTriangle& triangle : surface.triangles) {
    const auto role = roles.find(triangle.tag);
    if (role == roles.end()) continue;
    met.insert(triangle.tag);
    triangle.inner = role->second == SurfaceRole::inner;
    triangle.by_place = role->second == SurfaceRole::by_place;
  }
  for (const auto& [tag, role] : roles)
    if (!met.contains(tag))
      throw Error(ErrorKind::domain, "no triangle of the surfaces has the tag " +
                                         std::to_string(tag) + ", which was given a role");
}

void find_roles_by_place(Triangulation& surface) {
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
