// SPDX-License-Identifier: BSD-3-Clause
// What an element gives to the cells of its sites, as a row of numbers: the volumes of all sites,
// then the areas of all pairs, each once.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "voronoi/divided_element.hpp"

namespace pnpbs {

inline std::size_t place_of_pair(std::size_t sites, std::size_t a, std::size_t b) {
  if (a > b) std::swap(a, b);
  return sites + a * (2 * sites - a - 1) / 2 + (b - a - 1);
}

// Appends the row of an element. Its faces between corners are used up.
template <int Dim, std::size_t Corners>
void append_parts(DividedElement<Dim, Corners>& divided, std::vector<double>& out) {
  const std::size_t sites = divided.sites().size(), begin = out.size();
  out.resize(begin + sites + sites * (sites - 1) / 2);
  double* const row = out.data() + begin;
  for (std::size_t a = 0; a < sites; ++a)
    for (std::size_t b = a + 1; b < sites; ++b)
      row[place_of_pair(sites, a, b)] = divided.face(a, b).measure();
  for (std::size_t s = 0; s < sites; ++s)
    row[s] =
        divided.volume(s, [&](std::size_t other) { return row[place_of_pair(sites, s, other)]; });
}

}  // namespace pnpbs
