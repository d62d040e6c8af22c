// SPDX-License-Identifier: BSD-3-Clause
#include "domain/volume/msh_body.hpp"

#include <utility>
#include <vector>

#include "base/error.hpp"
#include "formats/msh_facets.hpp"
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

void add_surfaces(VolumeDomain& domain, const MshMesh& mesh, double feature_angle) {
  constexpr std::array<std::pair<MshSides, SurfaceRole>, 3> kRoles{
      {{MshSides::one_inside, SurfaceRole::boundary},
       {MshSides::both_inside, SurfaceRole::inner},
       {MshSides::unknown, SurfaceRole::by_place}}};
  const std::vector<MshFacet> facets = facets_of(mesh, 3);
  if (facets.empty())
    throw Error(ErrorKind::file, mesh.name +
                                     ": holds no triangles, quadrangles or elements of "
                                     "volumes, expected a body or its surface");
  for (const auto& [sides, role] : kRoles) {
    const SurfaceTriangles surface = triangles_of(mesh, facets, sides);
    if (surface.triangles.empty()) continue;
    domain.add_surface(role, surface, feature_angle);
  }
}

void add_curves(VolumeDomain& domain, const MshMesh& mesh) {
  const MshCells& cells = mesh.of(MshShape::line);
  std::vector<MshLine> lines;
  for (std::size_t e = 0; e < cells.count(); ++e)
    if (const std::int32_t group = mesh.regions[static_cast<std::size_t>(cells.regions[e])].group)
      lines.push_back({{cells.corners[2 * e], cells.corners[2 * e + 1]}, group, true});
  for (const MshCurve& curve : curves_of(lines, {})) {
    std::vector<double> xyz;
    for (const std::int32_t node : curve.nodes) {
      const Point<3>& x = mesh.nodes[static_cast<std::size_t>(node)];
      xyz.insert(xyz.end(), x.begin(), x.end());
    }
    const auto n = static_cast<std::int64_t>(curve.nodes.size());
    const std::vector<std::int32_t> tags(curve.nodes.size(), curve.tag);
    domain.add_polyline(curve.closed, n, xyz.data(), tags.data());
  }
}

void add_points(VolumeDomain& domain, const MshMesh& mesh) {
  const MshCells& cells = mesh.of(MshShape::point);
  for (std::size_t e = 0; e < cells.count(); ++e) {
    const std::int32_t group = mesh.regions[static_cast<std::size_t>(cells.regions[e])].group;
    if (group == 0) continue;
    domain.add_fixed_nodes(1, mesh.nodes[static_cast<std::size_t>(cells.corners[e])].data(),
                           &group);
  }
}

}  // namespace

void add_msh(VolumeDomain& domain, const MshMesh& mesh, double feature_angle) {
  VolumeDomain changed = domain;
  as_of_file(mesh, [&] {
    add_surfaces(changed, mesh, feature_angle);
    add_curves(changed, mesh);
    add_points(changed, mesh);
  });
  std::vector<std::string> warnings = mesh.warnings;
  warn_of_joined_regions(mesh, 3, warnings);
  for (std::string& warning : warnings) changed.add_warning(std::move(warning));
  for (const auto& [group, name] : mesh.names.all()) changed.names().add(group, name);
  domain = std::move(changed);
}

}  // namespace pnpbs
