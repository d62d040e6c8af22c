// SPDX-License-Identifier: BSD-3-Clause
// The elements that touch a rank's own nodes, whoever else has them, too: what a solver needs to
// assemble the rows of these nodes by itself.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "results/results.hpp"

namespace pnpbs {

namespace incident {

// Calls visit(other corners) for the elements around node i.
template <std::size_t Corners, int Dim, class Visit>
void for_elements_around(const Results<Dim>& results, std::int64_t i, const Visit& visit) {
  if constexpr (Corners == Dim + 1)
    results.level().stars.for_simplices(i, visit);
  else
    results.level().stars.for_triangles(i, visit);
}

// Calls visit(places of the corners) for each element once: at its first own node. They turn as the
// elements of the stars do.
template <std::size_t Corners, int Dim, class Visit>
void for_each_element(const Results<Dim>& results, const Visit& visit) {
  const std::int64_t owned = results.count();
  for (std::int64_t place = 0; place < owned; ++place)
    for_elements_around<Corners>(results, results.node_at(place), [&](const auto& others) {
      std::array<std::int64_t, Corners> places{place};
      for (std::size_t k = 0; k + 1 < Corners; ++k) {
        places[k + 1] = results.place_of(others[k]);
        if (places[k + 1] < place) return;  // ghosts have greater places than own nodes
      }
      visit(places);
    });
}

// The node with the least id comes first, of the others in space the one with the least id second;
// what is left is a matter of orientation.
template <std::size_t Corners, class Id>
void bring_least_id_first(std::array<std::int64_t, Corners>& places, const Id& id) {
  const auto less = [&](std::int64_t a, std::int64_t b) { return id(a) < id(b); };
  const auto least = std::min_element(places.begin(), places.end(), less) - places.begin();
  if constexpr (Corners == 3) {
    std::rotate(places.begin(), places.begin() + least, places.end());
  } else {
    // Two swaps keep the orientation.
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

// Corners: those of an element of the placement, Dim + 1, or 3 on surfaces alone. After
// prepare_stars.
template <std::size_t Corners, int Dim>
std::int64_t count_incident_elements(const Results<Dim>& results) {
  std::int64_t count = 0;
  incident::for_each_element<Corners>(results, [&](const auto&) { ++count; });
  return count;
}

// Places of their corners, in the order of the corners' ids: any two ranks have those that both
// have in the same order, with the same first corner.
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
