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

// Sorts those that follow each other with the same key(row).
template <class Row, class Key, class Less>
void sort_runs(std::vector<Row>& rows, const Key& key, const Less& less) {
  for (auto begin = rows.begin(), end = begin; begin != rows.end(); begin = end) {
    end = std::find_if(begin, rows.end(), [&](const Row& row) { return key(row) != key(*begin); });
    std::sort(begin, end, less);
  }
}

}  // namespace

template <std::size_t Corners, int Dim>
std::vector<MeshElement<Corners>> owned_elements(const Results<Dim>& results,
                                                 const std::vector<std::int64_t>& numbers) {
  using Element = MeshElement<Corners>;
  const NodeArray<std::int64_t>& ids = results.level().nodes.id;
  const auto id = [&](std::int64_t place) { return ids(results.node_at(place)); };
  std::vector<Element> elements;  // first by the places of their corners
  for_elements_and_tags<Corners>(results,
                                 [&](std::array<std::int64_t, Corners> places, std::int32_t tag) {
                                   incident::bring_least_id_first(places, id);
                                   elements.push_back({kNoElement, places, tag});
                                 });
  const auto by_ids = [&](const Element& a, const Element& b) {
    return std::ranges::lexicographical_compare(a.corners, b.corners, {}, id, id);
  };
  // Those that fill the domain come by the place of the least id already.
  if constexpr (Corners == Dim + 1)
    sort_runs(
        elements, [](const Element& element) { return element.corners[0]; }, by_ids);
  else
    std::ranges::sort(elements, by_ids);
  for (Element& element : elements)
    for (std::int64_t& corner : element.corners) corner = numbers[static_cast<std::size_t>(corner)];
  return elements;
}

template std::vector<MeshElement<3>> owned_elements(const Results<2>&,
                                                    const std::vector<std::int64_t>&);
template std::vector<MeshElement<3>> owned_elements(const Results<3>&,
                                                    const std::vector<std::int64_t>&);
template std::vector<MeshElement<4>> owned_elements(const Results<3>&,
                                                    const std::vector<std::int64_t>&);

}  // namespace pnpbs
