// SPDX-License-Identifier: BSD-3-Clause
#include "formats/msh_triangles.hpp"

#include "base/error.hpp"
#include "formats/polygons.hpp"

namespace pnpbs {

namespace {

// The mesh's nodes that a surface uses, numbered anew.
class UsedNodes {
 public:
  explicit UsedNodes(const MshMesh& mesh) : mesh_(mesh), number_(mesh.nodes.size(), -1) {}

  std::int32_t number_in(SurfaceTriangles& surface, std::int32_t node) {
    std::int32_t& number = number_[static_cast<std::size_t>(node)];
    if (number < 0) {
      number = static_cast<std::int32_t>(surface.vertices.size());
      surface.vertices.push_back(mesh_.nodes[static_cast<std::size_t>(node)]);
    }
    return number;
  }

 private:
  const MshMesh& mesh_;
  std::vector<std::int32_t> number_;
};

}  // namespace

SurfaceTriangles triangles_of(const MshMesh& mesh, const std::vector<MshFacet>& facets,
                              MshSides sides) {
  SurfaceTriangles surface;
  UsedNodes used(mesh);
  std::vector<std::int32_t> corners;
  for (const MshFacet& facet : facets) {
    if (facet.sides != sides) continue;
    corners.clear();
    for (const std::int32_t node : facet.nodes()) corners.push_back(used.number_in(surface, node));
    if (const auto problem = add_polygon(surface, corners, facet.tag); !problem.empty())
      throw Error(ErrorKind::file, mesh.name + ": " + problem);
  }
  return surface;
}

}  // namespace pnpbs
