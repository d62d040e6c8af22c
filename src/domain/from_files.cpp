// SPDX-License-Identifier: BSD-3-Clause
#include "domain/from_files.hpp"

#include <array>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "formats/msh_curves.hpp"
#include "formats/msh_facets.hpp"
#include "formats/msh_triangles.hpp"

namespace pnpbs {

namespace {

// Runs work that adds to a domain what a file holds: what is wrong with it is the file's fault.
template <class Work>
void as_of_file(const std::string& name, const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::argument) throw;
    throw Error(ErrorKind::file, name + ": " + error.what());
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
    const SurfaceTriangles surface = triangles_of(mesh, facets, sides);
    if (!surface.triangles.empty()) domain.add_surface(role, surface, feature_angle);
  }
}

template <int Dim>
void add_points(DomainBase<Dim>& domain, const MshMesh& mesh, const std::vector<MshPoint>& points) {
  for (const MshPoint& point : points)
    domain.add_fixed_nodes(1, mesh.nodes[static_cast<std::size_t>(point.node)].data(), &point.tag);
}

template <int Dim>
void add_names_and_warnings(DomainBase<Dim>& domain, const MshMesh& mesh) {
  std::vector<std::string> warnings = mesh.warnings;
  warn_of_joined_regions(mesh, Dim, warnings);
  for (std::string& warning : warnings) domain.add_warning(std::move(warning));
  for (const auto& [group, name] : mesh.names.all()) domain.names().add(group, name);
}

}  // namespace

void add_poly(PlaneDomain& domain, const PolyGraph& graph) {
  as_of_file(graph.name, [&] {
    domain.add_pslg(graph.vertices.count(), graph.vertices.coordinates.data(),
                    graph.vertices.tags.data(), std::ssize(graph.segment_tags),
                    graph.segment_ends.data(), graph.segment_tags.data(),
                    std::ssize(graph.holes) / 2, graph.holes.data(), graph.vertices.first_number);
  });
}

void add_msh(PlaneDomain& domain, const MshMesh& mesh, double corner_angle) {
  PlaneDomain changed = domain;
  as_of_file(mesh.name, [&] {
    const std::vector<MshPoint> points = points_in_groups(mesh);
    add_curves(changed, mesh, curves_of_plane(mesh, points), corner_angle);
    add_points<2>(changed, mesh, points);
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
  });
  add_names_and_warnings<3>(changed, mesh);
  domain = std::move(changed);
}

}  // namespace pnpbs
