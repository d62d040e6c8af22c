// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces/surfaces.hpp"

namespace pnpbs {

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

}  // namespace pnpbs
