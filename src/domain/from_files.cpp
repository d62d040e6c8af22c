// SPDX-License-Identifier: BSD-3-Clause
#include "domain/from_files.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "formats/msh_facets.hpp"

namespace pnpbs {

namespace {

// Runs `work`, which adds the contents of a file to a domain. Rethrows its argument errors as
// errors of that file.
template <class Work>
void as_of_file(const std::string& name, const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::argument) throw;
    throw Error(ErrorKind::file, name + ": " + error.message(), error.reason());
  }
}

template <int Dim>
std::vector<double> coordinates_of(const MshMesh& mesh, const MshCurve& curve) {
  std::vector<double> coordinates;
  for (const std::int32_t node : curve.nodes) {
    const Point<3>& x = mesh.nodes[static_cast<std::size_t>(node)];
    coordinates.insert(coordinates.end(), x.begin(), x.begin() + Dim);
  }
  return coordinates;
}

void add_curves(PlaneDomain& domain, const MshMesh& mesh, const std::vector<MshCurve>& curves,
                double corner_angle) {
  for (const MshCurve& curve : curves) {
    const std::vector<std::int32_t> tags(curve.nodes.size(), curve.tag);
    domain.add_polyline(curve.inner ? CurveRole::inner : CurveRole::boundary, curve.closed,
                        std::ssize(curve.nodes), coordinates_of<2>(mesh, curve).data(), tags.data(),
                        corner_angle);
  }
}

void add_curves(VolumeDomain& domain, const MshMesh& mesh, const std::vector<MshCurve>& curves) {
  for (const MshCurve& curve : curves) {
    const std::vector<std::int32_t> tags(curve.nodes.size(), curve.tag);
    domain.add_polyline(curve.closed, std::ssize(curve.nodes),
                        coordinates_of<3>(mesh, curve).data(), tags.data());
  }
}

void add_surfaces(VolumeDomain& domain, const MshMesh& mesh, double feature_angle) {
  constexpr std::array<std::pair<MshSides, SurfaceRole>, 3> kRoles{
      {{MshSides::one_inside, SurfaceRole::boundary},
       {MshSides::both_inside, SurfaceRole::inner},
       {MshSides::unknown, SurfaceRole::by_place}}};
  const std::vector<MshFacet> facets = facets_of(mesh, 3);
  for (const auto& [sides, role] : kRoles) {
    SurfaceTriangles surface = triangles_of(mesh, facets, sides);
    for (const auto& [group, name] : mesh.names.all())
      if (group.dimension == 2) surface.tag_names.emplace_back(group.tag, name);
    if (!surface.triangles.empty()) domain.add_surface(role, surface, feature_angle);
  }
}

template <int Dim>
void add_points(DomainBase<Dim>& domain, const MshMesh& mesh, const std::vector<MshPoint>& points) {
  for (const MshPoint& point : points)
    domain.add_fixed_nodes(1, mesh.nodes[static_cast<std::size_t>(point.node)].data(), &point.tag);
}

template <int Dim>
void add_regions(DomainBase<Dim>& domain, const MshMesh& mesh) {
  for (const MshRegionPoint& region : region_points_of(mesh, Dim)) {
    Point<Dim> point;
    std::copy_n(region.point.begin(), Dim, point.begin());
    domain.add_region_of_file(point, region.tag, mesh.name + ": a part of " + region.name);
  }
}

template <int Dim>
void add_names_and_warnings(DomainBase<Dim>& domain, const MshMesh& mesh) {
  for (const Warning& warning : mesh.warnings) domain.add_warning(warning);
  for (const auto& [group, name] : mesh.names.all()) domain.names().add(group, name);
}

}  // namespace

void add_poly(PlaneDomain& domain, const PolyGraph& graph) {
  PlaneDomain changed = domain;
  as_of_file(graph.name, [&] {
    changed.add_pslg(graph.vertices.count(), graph.vertices.coordinates.data(),
                     graph.vertices.tags.data(), std::ssize(graph.segment_tags),
                     graph.segment_ends.data(), graph.segment_tags.data(),
                     std::ssize(graph.holes) / 2, graph.holes.data(), graph.vertices.first_number);
    const RegionSection<2>& regions = graph.regions;
    for (std::size_t k = 0; k < regions.tags.size(); ++k)
      changed.add_region_of_file({regions.points[2 * k], regions.points[2 * k + 1]},
                                 regions.tags[k], graph.name + ": " + regions.names[k]);
  });
  if (auto warning = warning_of_skipped(graph.regions.skipped, graph.name))
    changed.add_warning(std::move(*warning));
  domain = std::move(changed);
}

void add_msh(PlaneDomain& domain, const MshMesh& mesh, double corner_angle) {
  PlaneDomain changed = domain;
  as_of_file(mesh.name, [&] {
    const std::vector<MshPoint> points = points_in_groups(mesh);
    add_curves(changed, mesh, curves_of_plane(mesh, points), corner_angle);
    add_points<2>(changed, mesh, points);
    add_regions<2>(changed, mesh);
  });
  add_names_and_warnings<2>(changed, mesh);
  domain = std::move(changed);
}

void add_msh(VolumeDomain& domain, const MshMesh& mesh, double feature_angle) {
  VolumeDomain changed = domain;
  as_of_file(mesh.name, [&] {
    add_surfaces(changed, mesh, feature_angle);
    add_curves(changed, mesh, curves_in_groups(mesh));
    add_points<3>(changed, mesh, points_in_groups(mesh));
    add_regions<3>(changed, mesh);
  });
  add_names_and_warnings<3>(changed, mesh);
  domain = std::move(changed);
}

}  // namespace pnpbs
