// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/owned_elements.hpp"

#include <algorithm>
#include <array>

#include "placement/element_regions.hpp"
#include "placement/incident_elements.hpp"

namespace pnpbs {

std::vector<std::int64_t> node_numbers(NodalResults& results, const RankRanges& nodes) {
  const auto pattern = results.exchange_pattern();
  std::vector<std::int64_t> numbers(static_cast<std::size_t>(results.nodes().count));
  for (std::int64_t place = 0; place < nodes.count(); ++place)
    numbers[static_cast<std::size_t>(place)] = nodes.first() + place;
  fill_ghosts(results.communicator(), *pattern, numbers);
  return numbers;
}

namespace {

// Calls visit(places, tag), the place of the least id first.
template <std::size_t Corners, int Dim, class Visit>
void for_elements_and_tags(const Results<Dim>& results, const Visit& visit) {
  if constexpr (Corners == Dim + 1) {
    ElementRegions<Dim> region_of(results);
    results.for_elements([&](const auto& places) { visit(places, region_of(places)); });
  } else {
    results.for_boundary_facets(visit);
  }
}

}  // namespace

template <std::size_t Corners, int Dim>
std::vector<MeshElement<Corners>> owned_elements(const Results<Dim>& results,
                                                 const std::vector<std::int64_t>& numbers) {
  struct Found {
    std::array<std::int64_t, Corners> places;
    std::int32_t tag;
  };
  const NodeArray<std::int64_t>& ids = results.level().nodes.id;
  const auto id = [&](std::int64_t place) { return ids(results.node_at(place)); };
  std::vector<Found> found;
  for_elements_and_tags<Corners>(results,
                                 [&](std::array<std::int64_t, Corners> places, std::int32_t tag) {
                                   incident::bring_least_id_first(places, id);
                                   found.push_back({places, tag});
                                 });
  std::ranges::sort(found, [&](const Found& a, const Found& b) {
    return std::ranges::lexicographical_compare(a.places, b.places, {}, id, id);
  });
  std::vector<MeshElement<Corners>> elements;
  for (const Found& one : found) {
    MeshElement<Corners> element{kNoElement, {}, one.tag};
    for (std::size_t k = 0; k < Corners; ++k)
      element.corners[k] = numbers[static_cast<std::size_t>(one.places[k])];
    elements.push_back(element);
  }
  return elements;
}

template std::vector<MeshElement<3>> owned_elements(const Results<2>&,
                                                    const std::vector<std::int64_t>&);
template std::vector<MeshElement<3>> owned_elements(const Results<3>&,
                                                    const std::vector<std::int64_t>&);
template std::vector<MeshElement<4>> owned_elements(const Results<3>&,
                                                    const std::vector<std::int64_t>&);

}  // namespace pnpbs
