// SPDX-License-Identifier: BSD-3-Clause
#include "level/volume/surface_fit.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "level/found_nodes.hpp"
#include "level/level.hpp"
#include "level/volume/surface_stars.hpp"

namespace pnpbs {

namespace {

// Triangles around a node: the other two corners of each, counter-clockwise as seen from outside.
using Side = std::pair<std::int32_t, std::int32_t>;
using Fan = std::vector<Side>;  // sorted

bool has(const Fan& fan, std::int32_t from, std::int32_t to) {
  return std::ranges::binary_search(fan, Side{from, to});
}

// The triangles around node i that its star within the surfaces has.
Fan fan_on_surfaces(const Level<3>& level, std::int64_t i) {
  const std::vector<SurfaceStarEntry> star = surface_star(level, i, true);
  Fan fan;
  for (std::size_t k = 0; k < star.size(); ++k)
    if (star[k].triangle) fan.emplace_back(star[k].node, star[(k + 1) % star.size()].node);
  std::ranges::sort(fan);
  return fan;
}

// Those that have tetrahedra on one side only.
Fan fan_of_tetrahedra(const Level<3>& level, std::int64_t i) {
  Fan all, open;
  // (i, a, b, c) turns right-handed: from outside, its faces with i turn as i, b, a.
  level.stars.for_simplices(i, [&](const Stars<3>::Corners& others) {
    for (std::size_t k = 0; k < 3; ++k) all.emplace_back(others[(k + 1) % 3], others[k]);
  });
  std::ranges::sort(all);
  for (const auto& [a, b] : all)
    if (!has(all, b, a)) open.emplace_back(a, b);
  return open;
}

class Fitting {
 public:
  explicit Fitting(const Level<3>& level) : level_(level), nodes_(level.nodes) {}

  // Triangles of which this is the node that judges.
  std::int64_t missing_at(std::int64_t i) const {
    const Fan wanted = fan_on_surfaces(level_, i), found = fan_of_tetrahedra(level_, i);
    if (lies_in_plane(i, found)) return 0;
    std::int64_t missing = 0;
    for (const Side& side : wanted) missing += judges(i, side) && !is_in(found, wanted, side, i);
    for (const Side& side : found)
      missing += judges(i, side) &&
                 !(wanted.empty() ? on_one_surface(i, side) : is_in(wanted, found, side, i));
    return missing;
  }

 private:
  // One of the corners: within a surface, if there is one, of those the one with the least id.
  bool judges(std::int64_t i, const Side& others) const {
    const auto rank = [&](std::int64_t j) {
      return std::pair(nodes_.carrier(j) != Carrier::surface, nodes_.id(j));
    };
    const auto before = [&](std::int64_t j) {
      return nodes_.carrier(j) == Carrier::free || rank(i) < rank(j);
    };
    return before(others.first) && before(others.second);
  }

  bool sees(std::int64_t i, std::int64_t j) const {
    const auto place = [&](std::int64_t node) {
      return level_.ground.place(nodes_.carrier(node), nodes_.boundary_node(node));
    };
    return nodes_.carrier(j) != Carrier::free && level_.ground.surface().sees(place(i), place(j));
  }
  bool on_one_surface(std::int64_t i, const Side& side) const {
    return sees(i, side.first) && sees(i, side.second) && sees(side.first, side.second);
  }

  // Within a flat surface, triangles on it follow it whatever their diagonals are.
  bool lies_in_plane(std::int64_t i, const Fan& fan) const {
    if (nodes_.carrier(i) != Carrier::surface || fan.empty()) return false;
    const Surface& surface = level_.ground.surface();
    return surface.is_flat(surface.patch(nodes_.boundary_node(i))) &&
           std::ranges::all_of(fan, [&](const Side& side) { return on_one_surface(i, side); });
  }

  // Is the triangle of node i, one of `own`, in the other fan, or one that differs by a diagonal?
  bool is_in(const Fan& other, const Fan& own, const Side& side, std::int64_t i) const {
    const auto a = side.first, b = side.second;
    if (has(other, a, b)) return true;
    // The other diagonal ends here ...
    for (auto next = std::ranges::lower_bound(other, Side{a, -1});
         next != other.end() && next->first == a; ++next)
      if (has(other, next->second, b) && sees(i, next->second)) return true;
    // ... or this one does.
    for (auto next = std::ranges::lower_bound(own, Side{b, -1});
         next != own.end() && next->first == b; ++next)
      if (has(other, a, next->second)) return true;
    return std::ranges::any_of(
        own, [&](const Side& before) { return before.second == a && has(other, before.first, b); });
  }

  const Level<3>& level_;
  const Nodes<3>& nodes_;
};

}  // namespace

SurfaceFit measure_surface_fit(const Level<3>& level) {
  const Nodes<3>& nodes = level.nodes;
  FoundNodes<3> missing;
  agreed(*level.comm, [&] {
    const Fitting fitting(level);
    for (std::int64_t i = 0; i < nodes.count; ++i) {
      if (!nodes.owned(i) || nodes.carrier(i) == Carrier::free) continue;
      missing.add(fitting.missing_at(i), nodes.id(i), nodes.position(i));
    }
  });
  missing = over_ranks(*level.comm, missing);
  return {missing.count, missing.at};
}

}  // namespace pnpbs
