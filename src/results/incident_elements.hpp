// SPDX-License-Identifier: BSD-3-Clause
// The elements that touch a rank's owned nodes, even if other ranks have them as well. A solver
// needs them to assemble the rows of these nodes without communication.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "results/results.hpp"

namespace pnpbs {

namespace incident {

// Calls visit(other corners) for the elements around node i, by memory indices.
template <std::size_t Corners, int Dim, class Visit>
void for_elements_around(const Results<Dim>& results, std::int64_t i, const Visit& visit) {
  if constexpr (Corners == Dim + 1)
    results.level().stars.for_simplices(i, visit);
  else
    results.level().stars.for_triangles(i, visit);
}

// Calls visit(result indices of the corners) for each element once, at its owned node with the
// smallest result index. The orientation is that of the stars.
template <std::size_t Corners, int Dim, class Visit>
void for_each_element(const Results<Dim>& results, const Visit& visit) {
  const std::int64_t owned = results.count();
  for (std::int64_t place = 0; place < owned; ++place)
    for_elements_around<Corners>(results, results.node_at(place), [&](const auto& others) {
      std::array<std::int64_t, Corners> places{place};
      for (std::size_t k = 0; k + 1 < Corners; ++k) {
        places[k + 1] = results.place_of(others[k]);
        if (places[k + 1] < place) return;  // ghosts have larger result indices than owned nodes
      }
      visit(places);
    });
}

// Permutes the corners so that the node with the smallest id is first and, in space, the one with
// the smallest id of the others second. The orientation does not change, which fixes the remaining
// order.
template <std::size_t Corners, class Id>
void bring_least_id_first(std::array<std::int64_t, Corners>& places, const Id& id) {
  const auto less = [&](std::int64_t a, std::int64_t b) { return id(a) < id(b); };
  const auto least = std::min_element(places.begin(), places.end(), less) - places.begin();
  if constexpr (Corners == 3) {
    std::rotate(places.begin(), places.begin() + least, places.end());
  } else {
    // An even number of swaps keeps the orientation.
    if (least != 0) {
      std::swap(places[0], places[static_cast<std::size_t>(least)]);
      const std::size_t one = least == 1 ? 2 : 1, two = least == 3 ? 2 : 3;
      std::swap(places[one], places[two]);
    }
    std::rotate(places.begin() + 1, std::min_element(places.begin() + 1, places.end(), less),
                places.end());
  }
}

}  // namespace incident

// Returns the number of elements that touch owned nodes. Corners is Dim + 1, or 3 for surfaces
// without a body. Requires prepare_stars().
template <std::size_t Corners, int Dim>
std::int64_t count_incident_elements(const Results<Dim>& results) {
  std::int64_t count = 0;
  incident::for_each_element<Corners>(results, [&](const auto&) { ++count; });
  return count;
}

// Returns the result indices of their corners, sorted by the ids of the corners. Any two ranks have
// their common elements in the same order and with the same first corner.
template <std::size_t Corners, int Dim>
std::vector<std::array<std::int64_t, Corners>> incident_elements(const Results<Dim>& results) {
  const NodeArray<std::int64_t>& ids = results.level().nodes.id;
  const auto id = [&](std::int64_t place) { return ids(results.node_at(place)); };
  std::vector<std::array<std::int64_t, Corners>> elements;
  incident::for_each_element<Corners>(results, [&](std::array<std::int64_t, Corners> places) {
    incident::bring_least_id_first(places, id);
    elements.push_back(places);
  });
  std::ranges::sort(elements, [&](const auto& a, const auto& b) {
    return std::ranges::lexicographical_compare(a, b, {}, id, id);
  });
  return elements;
}

}  // namespace pnpbs
