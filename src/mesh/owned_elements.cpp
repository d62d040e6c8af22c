// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/owned_elements.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "results/element_regions.hpp"
#include "results/incident_elements.hpp"

namespace pnpbs {

std::vector<std::int64_t> node_numbers(NodalResults& results, const RankRanges& nodes) {
  const auto pattern = results.exchange_pattern();
  std::vector<std::int64_t> numbers(static_cast<std::size_t>(results.held()));
  for (std::int64_t place = 0; place < nodes.count(); ++place)
    numbers[static_cast<std::size_t>(place)] = nodes.first() + place;
  fill_ghosts(results.communicator(), *pattern, numbers);
  return numbers;
}

namespace {

// Expected number of elements per node where no boundary is near. It serves to reserve memory.
template <std::size_t Corners>
constexpr std::size_t kUsualElements = Corners == 3 ? 2 : 6;

// Returns the ids by index in the results. Sorting compares them often, so they are contiguous.
template <int Dim>
std::vector<std::int64_t> ids_by_place(const Results<Dim>& results) {
  const Nodes<Dim>& nodes = results.level().nodes;
  std::vector<std::int64_t> ids(static_cast<std::size_t>(nodes.count));
  for (std::int64_t place = 0; place < nodes.count; ++place)
    ids[static_cast<std::size_t>(place)] = nodes.id(results.node_at(place));
  return ids;
}

// Calls visit(corners, tag) for each owned element; corners are indices in the results, the one
// with the smallest id first.
template <std::size_t Corners, int Dim, class Visit>
void for_elements_and_tags(const Results<Dim>& results, const Visit& visit) {
  if constexpr (Corners == Dim + 1) {
    ElementRegions<Dim> region_of(results);
    results.for_elements([&](const auto& places) { visit(places, region_of(places)); });
  } else {
    results.for_boundary_facets(visit);
  }
}

// A list of elements that is sorted by the ids of their corners.
template <std::size_t Corners, int Dim>
class ElementsInOrder {
 public:
  using Element = MeshElement<Corners>;

  ElementsInOrder(const Results<Dim>& results, const std::vector<std::int64_t>& numbers)
      : numbers_(numbers), ids_(ids_by_place(results)) {
    elements_.reserve(static_cast<std::size_t>(results.count()) * kUsualElements<Corners>);
  }

  // Adds an element by the indices of its corners in the results. Elements of the plane and of
  // volumes come grouped by their first corner in the order of ids, so only each group needs
  // sorting.
  void add(std::array<std::int64_t, Corners> places, std::int32_t tag) {
    if constexpr (Corners == Dim + 1)
      if (sorted_ < elements_.size() && elements_.back().corners[0] != places[0]) sort_last();
    incident::bring_least_id_first(places, [&](std::int64_t place) { return id(place); });
    elements_.push_back({kNoElement, places, tag});
  }

  std::vector<Element> take() {
    sort_last();
    return std::move(elements_);
  }

 private:
  std::int64_t id(std::int64_t place) const { return ids_[static_cast<std::size_t>(place)]; }

  // Sorts the elements added since the last call and replaces the indices of their corners by
  // numbers.
  void sort_last() {
    const auto begin = elements_.begin() + static_cast<std::ptrdiff_t>(sorted_);
    std::sort(begin, elements_.end(), [&](const Element& a, const Element& b) {
      for (std::size_t k = 0; k < Corners; ++k)
        if (a.corners[k] != b.corners[k]) return id(a.corners[k]) < id(b.corners[k]);
      return false;
    });
    for (auto element = begin; element != elements_.end(); ++element)
      for (std::int64_t& corner : element->corners)
        corner = numbers_[static_cast<std::size_t>(corner)];
    sorted_ = elements_.size();
  }

  const std::vector<std::int64_t>& numbers_;
  const std::vector<std::int64_t> ids_;
  std::vector<Element> elements_;
  std::size_t sorted_ = 0;  // number of elements sorted
};

}  // namespace

template <std::size_t Corners, int Dim>
std::vector<MeshElement<Corners>> owned_elements(const Results<Dim>& results,
                                                 const std::vector<std::int64_t>& numbers) {
  ElementsInOrder<Corners, Dim> elements(results, numbers);
  for_elements_and_tags<Corners>(
      results, [&](const auto& places, std::int32_t tag) { elements.add(places, tag); });
  return elements.take();
}

template std::vector<MeshElement<3>> owned_elements(const Results<2>&,
                                                    const std::vector<std::int64_t>&);
template std::vector<MeshElement<3>> owned_elements(const Results<3>&,
                                                    const std::vector<std::int64_t>&);
template std::vector<MeshElement<4>> owned_elements(const Results<3>&,
                                                    const std::vector<std::int64_t>&);

}  // namespace pnpbs
