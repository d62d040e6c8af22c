// SPDX-License-Identifier: BSD-3-Clause
#include "io/entity_rows.hpp"

namespace pnpbs::io {

EntityRows::EntityRows(const SphereGrid& grid) : grid_(grid) {
  for (std::int32_t i = 0; i < grid.owned; ++i)
    if (grid.has_cell(i)) leaders_.push_back(i);
}

std::int64_t EntityRows::number(Entity of, const EntityPlace& at) const {
  if (of == Entity::cell) return grid_.cell[static_cast<std::size_t>(at.node)];
  if (of == Entity::edge) return grid_.edge[static_cast<std::size_t>(at.place)];
  return grid_.vertex[static_cast<std::size_t>(grid_.rings.triangle(at.place))];
}

std::vector<EntityPlace> EntityRows::led(Entity of, std::int64_t begin, std::int64_t end) const {
  const auto first_from = [&](std::int64_t bound) {
    return leading_count(std::ssize(leaders_), [&](std::int64_t k) {
      return grid_.cell[static_cast<std::size_t>(leaders_[static_cast<std::size_t>(k)])] < bound;
    });
  };
  std::vector<EntityPlace> places;
  const std::int64_t last = first_from(end);
  for (std::int64_t l = first_from(begin); l < last; ++l) {
    const std::int32_t node = leaders_[static_cast<std::size_t>(l)];
    const std::int64_t ring = grid_.rings.begin(node);
    if (of == Entity::cell) {
      places.push_back({node, ring});
      continue;
    }
    const std::ptrdiff_t first = std::ssize(places);
    for (std::int64_t k = ring; k < grid_.rings.end(node); ++k) {
      const bool leads = of == Entity::edge ? grid_.leads(node, grid_.rings.neighbour(k))
                                            : grid_.leader_of(grid_.rings.triangle(k)) == node;
      if (leads) places.push_back({node, k});
    }
    std::ranges::sort(places.begin() + first, places.end(), {},
                      [&](const EntityPlace& at) { return number(of, at); });
  }
  return places;
}

}  // namespace pnpbs::io
