// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/mesh_spacing.hpp"

#include <algorithm>
#include <cmath>

#include "base/started_execution.hpp"
#include "spacing/simplex_slope.hpp"

namespace pnpbs {

namespace {

// Those of one simplex alone. Where neighbours do not share whole facets, some inside are among
// them: as these are within the mesh, they are the nearest to no point beyond it.
template <int Dim>
std::vector<std::array<std::int32_t, Dim>> open_facets(
    const std::vector<std::array<std::int32_t, Dim + 1>>& simplices) {
  std::vector<std::array<std::int32_t, Dim>> facets;
  facets.reserve(simplices.size() * (Dim + 1));
  for (const auto& simplex : simplices)
    for (std::size_t without = 0; without <= Dim; ++without) {
      std::array<std::int32_t, Dim> facet;
      std::copy_n(simplex.begin(), without, facet.begin());
      std::copy(simplex.begin() + static_cast<std::ptrdiff_t>(without) + 1, simplex.end(),
                facet.begin() + static_cast<std::ptrdiff_t>(without));
      facets.push_back(facet);
    }
  std::sort(facets.begin(), facets.end());
  std::vector<std::array<std::int32_t, Dim>> open;
  for (auto facet = facets.begin(); facet != facets.end();) {
    const auto next = std::find_if(facet, facets.end(), [&](const auto& f) { return f != *facet; });
    if (next - facet == 1) open.push_back(*facet);
    facet = next;
  }
  return open;
}

template <int Dim>
Patch<Dim> patch_of(const GivenField<Dim>& field) {
  Patch<Dim> patch;
  patch.nodes.reserve(field.points.size());
  for (std::size_t i = 0; i < field.points.size(); ++i)
    patch.nodes.push_back({field.points[i], static_cast<std::int64_t>(i), field.values[i]});
  patch.simplices = field.elements;
  for (auto& simplex : patch.simplices) std::sort(simplex.begin(), simplex.end());
  patch.border = open_facets<Dim>(patch.simplices);
  return patch;
}

}  // namespace

template <int Dim>
MeshSpacing<Dim>::MeshSpacing(const GivenField<Dim>& field)
    : mesh_(patch_of(field)), box_(box_of(field)) {}

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
KnownValues<Dim> MeshSpacing<Dim>::known_values() const {
  const Patch<Dim>& patch = mesh_.patch();
  KnownValues<Dim> known;
  std::vector<bool> used(patch.nodes.size(), false);
  for (const auto& simplex : patch.simplices) {
    for (const std::int32_t i : simplex) used[static_cast<std::size_t>(i)] = true;
    known.slopes.push_back(slope_of(patch, simplex));
  }
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) known.values.push_back({patch.nodes[i].x, patch.nodes[i].value});
  return known;
}

template class MeshSpacing<2>;
template class MeshSpacing<3>;

}  // namespace pnpbs
