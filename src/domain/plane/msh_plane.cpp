// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/msh_plane.hpp"

#include <map>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "formats/msh_facets.hpp"

namespace pnpbs {

namespace {

void require_plane(const MshMesh& mesh) {
  if (mesh.dimension() != 2)
    throw Error(ErrorKind::file, mesh.name +
                                     ": holds a mesh in space, expected one in a plane of "
                                     "constant z");
}

// Of lines of which the file does not tell more, those that belong to open chains lie inside.
void find_open_chains(const std::vector<MshFacet>& facets, std::vector<MshLine>& lines) {
  std::map<std::int32_t, std::vector<std::size_t>> at;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (facets[i].sides == MshSides::unknown)
      for (const std::int32_t end : lines[i].ends) at[end].push_back(i);
  std::vector<std::int32_t> ends;
  for (const auto& [node, here] : at)
    if (here.size() == 1) ends.push_back(node);
  while (!ends.empty()) {
    const std::int32_t node = ends.back();
    ends.pop_back();
    if (at[node].size() != 1) continue;
    const std::size_t line = at[node].front();
    lines[line].inner = true;
    for (const std::int32_t end : lines[line].ends) {
      std::erase(at[end], line);
      if (at[end].size() == 1) ends.push_back(end);
    }
  }
}

std::vector<MshLine> lines_of(const MshMesh& mesh) {
  const std::vector<MshFacet> facets = facets_of(mesh, 2);
  if (facets.empty())
    throw Error(ErrorKind::file, mesh.name +
                                     ": holds no lines, triangles or quadrangles, expected a "
                                     "domain or its boundary");
  std::vector<MshLine> lines;
  for (const MshFacet& facet : facets)
    lines.push_back(
        {{facet.corners[0], facet.corners[1]}, facet.tag, facet.sides == MshSides::both_inside});
  find_open_chains(facets, lines);
  return lines;
}

struct FixedPoint {
  std::int32_t node, tag;
};

std::vector<FixedPoint> points_of(const MshMesh& mesh) {
  const MshCells& cells = mesh.of(MshShape::point);
  std::vector<FixedPoint> points;
  for (std::size_t e = 0; e < cells.count(); ++e)
    if (const std::int32_t group = mesh.regions[static_cast<std::size_t>(cells.regions[e])].group)
      points.push_back({cells.corners[e], group});
  return points;
}

void add_curves(PlaneDomain& domain, const MshMesh& mesh, const std::vector<FixedPoint>& points,
                double corner_angle) {
  std::vector<std::int32_t> stops;
  for (const FixedPoint& point : points) stops.push_back(point.node);
  for (const MshCurve& curve : curves_of(lines_of(mesh), stops)) {
    std::vector<double> xy;
    for (const std::int32_t node : curve.nodes)
      for (const std::size_t k : {0, 1})
        xy.push_back(mesh.nodes[static_cast<std::size_t>(node)][k]);
    const std::vector<std::int32_t> tags(curve.nodes.size(), curve.tag);
    domain.add_polyline(curve.inner ? CurveRole::inner : CurveRole::boundary, curve.closed,
                        static_cast<std::int64_t>(curve.nodes.size()), xy.data(), tags.data(),
                        corner_angle);
  }
}

}  // namespace

void add_msh(PlaneDomain& domain, const MshMesh& mesh, double corner_angle) {
  require_plane(mesh);
  const std::vector<FixedPoint> points = points_of(mesh);
  PlaneDomain changed = domain;
  as_of_file(mesh, [&] {
    add_curves(changed, mesh, points, corner_angle);
    for (const FixedPoint& point : points)
      changed.add_fixed_nodes(1, mesh.nodes[static_cast<std::size_t>(point.node)].data(),
                              &point.tag);
  });
  std::vector<std::string> warnings = mesh.warnings;
  warn_of_joined_regions(mesh, 2, warnings);
  for (std::string& warning : warnings) changed.add_warning(std::move(warning));
  for (const auto& [group, name] : mesh.names.all()) changed.names().add(group, name);
  domain = std::move(changed);
}

}  // namespace pnpbs
