// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/mesh_spacing.hpp"

#include <algorithm>
#include <cmath>

#include "base/started_execution.hpp"
#include "spacing/mesh_patch.hpp"

namespace pnpbs {

template <int Dim>
MeshSpacing<Dim>::MeshSpacing(const GivenField<Dim>& field)
    : mesh_(patch_of_mesh<Dim, Dim>(field)), box_(box_of(field)) {}

template <int Dim>
PatchAnswer<Dim> MeshSpacing<Dim>::answer_at(const Point<Dim>& x) const {
  PatchAnswer<Dim> answer;
  mesh_.interpolate(x, answer);
  if (!answer.found()) mesh_.extend(x, answer);
  return answer;
}

template <int Dim>
void MeshSpacing<Dim>::evaluate(std::int64_t n, const Point<Dim>* x, double* d) const {
  for_each_if_started("pnpbs::MeshSpacing::evaluate", n,
                      [=, this](std::int64_t i) { d[i] = answer_at(x[i]).value; });
}

template <int Dim>
std::optional<GivenExtent<Dim>> MeshSpacing<Dim>::extent() const {
  return GivenExtent<Dim>{"background mesh", "d is that of the mesh's nearest point", box_};
}

template <int Dim>
void MeshSpacing<Dim>::distance_to_extent(std::int64_t n, const Point<Dim>* x,
                                          double* distance) const {
  for_each_if_started("pnpbs::MeshSpacing::distance_to_extent", n,
                      [=, this](std::int64_t i) { distance[i] = std::sqrt(answer_at(x[i]).gap); });
}

template <int Dim>
SpacingHints<Dim> MeshSpacing<Dim>::spacing_hints() const {
  return spacing_hints_of(mesh_.patch());
}

template class MeshSpacing<2>;
template class MeshSpacing<3>;

SphereMeshSpacing::SphereMeshSpacing(const SphereField& field, double radius)
    : radius_(radius), mesh_(patch_of_mesh<2, 3>(field), radius) {}

PatchAnswer<2> SphereMeshSpacing::answer_at(const Point<3>& x) const {
  PatchAnswer<2> answer;
  mesh_.interpolate(x, answer);
  if (!answer.found()) mesh_.extend(x, answer);
  return answer;
}

void SphereMeshSpacing::evaluate(std::int64_t n, const Point<3>* x, double* d) const {
  for_each_if_started("pnpbs::SphereMeshSpacing::evaluate", n,
                      [=, this](std::int64_t i) { d[i] = answer_at(x[i]).value; });
}

std::optional<GivenExtent<3>> SphereMeshSpacing::extent() const {
  return GivenExtent<3>{"background mesh", "d is that of the mesh's nearest point", {}};
}

void SphereMeshSpacing::distance_to_extent(std::int64_t n, const Point<3>* x,
                                           double* distances) const {
  for_each_if_started("pnpbs::SphereMeshSpacing::distance_to_extent", n, [=, this](std::int64_t i) {
    const double straight = std::sqrt(answer_at(x[i]).gap) / (2 * radius_);
    distances[i] = 2 * radius_ * std::asin(std::min(1.0, straight));
  });
}

SpacingHints<3> SphereMeshSpacing::spacing_hints() const { return spacing_hints_of(mesh_.patch()); }

}  // namespace pnpbs
