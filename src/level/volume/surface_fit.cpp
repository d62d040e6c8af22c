// SPDX-License-Identifier: BSD-3-Clause
#include "level/volume/surface_fit.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/found_indices.hpp"
#include "level/found_nodes.hpp"
#include "level/level.hpp"
#include "level/volume/open_faces.hpp"
#include "level/volume/surface_stars.hpp"

namespace pnpbs {

namespace {

// The triangles around node i that its star within the surfaces has.
FaceFan fan_on_surfaces(const Level<3>& level, std::int64_t i) {
  const std::vector<SurfaceStarEntry> star = surface_star(level, i, true);
  FaceFan fan;
  for (std::size_t k = 0; k < star.size(); ++k)
    if (star[k].triangle) fan.emplace_back(star[k].node, star[(k + 1) % star.size()].node);
  std::ranges::sort(fan);
  return fan;
}

class Fitting {
 public:
  explicit Fitting(const Level<3>& level) : level_(level), nodes_(level.nodes) {}

  // Triangles of which this is the node that judges.
  std::int64_t missing_at(std::int64_t i) const {
    const FaceFan wanted = fan_on_surfaces(level_, i), found = open_faces(level_, i);
    if (lies_in_plane(i, found)) return 0;
    std::int64_t missing = 0;
    for (const FaceSide& side : wanted)
      missing += judges(i, side) && !is_in(found, wanted, side, i);
    for (const FaceSide& side : found)
      missing += judges(i, side) &&
                 !(wanted.empty() ? on_one_surface(i, side) : is_in(wanted, found, side, i));
    return missing;
  }

 private:
  // One of the corners: within a surface, if there is one, of those the one with the least id.
  bool judges(std::int64_t i, const FaceSide& others) const {
    const auto rank = [&](std::int64_t j) {
      return std::pair(nodes_.carrier(j) != Carrier::surface, nodes_.id(j));
    };
    const auto before = [&](std::int64_t j) {
      return nodes_.carrier(j) == Carrier::free || rank(i) < rank(j);
    };
    return before(others.first) && before(others.second);
  }

  bool sees(std::int64_t i, std::int64_t j) const {
    const Ground<3>& ground = level_.ground;
    return nodes_.carrier(j) != Carrier::free &&
           ground.surface().sees(ground.place(nodes_, i), ground.place(nodes_, j));
  }
  bool on_one_surface(std::int64_t i, const FaceSide& side) const {
    return sees(i, side.first) && sees(i, side.second) && sees(side.first, side.second);
  }

  // Within a flat surface, triangles on it follow it whatever their diagonals are.
  bool lies_in_plane(std::int64_t i, const FaceFan& fan) const {
    if (nodes_.carrier(i) != Carrier::surface || fan.empty()) return false;
    const Surface& surface = level_.ground.surface();
    return surface.is_flat(surface.patch(nodes_.boundary_node(i))) &&
           std::ranges::all_of(fan, [&](const FaceSide& side) { return on_one_surface(i, side); });
  }

  // Is the triangle of node i, one of `own`, in the other fan, or one that differs by a diagonal?
  bool is_in(const FaceFan& other, const FaceFan& own, const FaceSide& side, std::int64_t i) const {
    const auto a = side.first, b = side.second;
    if (has_side(other, a, b)) return true;
    // The other diagonal ends here ...
    for (auto next = std::ranges::lower_bound(other, FaceSide{a, -1});
         next != other.end() && next->first == a; ++next)
      if (has_side(other, next->second, b) && sees(i, next->second)) return true;
    // ... or this one does.
    for (auto next = std::ranges::lower_bound(own, FaceSide{b, -1});
         next != own.end() && next->first == b; ++next)
      if (has_side(other, a, next->second)) return true;
    return std::ranges::any_of(own, [&](const FaceSide& before) {
      return before.second == a && has_side(other, before.first, b);
    });
  }

  const Level<3>& level_;
  const Nodes<3>& nodes_;
};

}  // namespace

SurfaceFit measure_surface_fit(const Level<3>& level) {
  const Nodes<3>& nodes = level.nodes;
  FoundNodes<3> missing;
  std::vector<Point<3>> places;
  agreed(*level.comm, [&] {
    const Fitting fitting(level);
    const auto misses_any = [&](std::int64_t i) {
      return nodes.owned(i) && nodes.carrier(i) != Carrier::free && fitting.missing_at(i) > 0;
    };
    for (const std::int64_t i : indices_where("pnpbs::surface_fit", nodes.count, misses_any)) {
      missing.add(fitting.missing_at(i), nodes.id(i), nodes.position(i));
      places.push_back(nodes.position(i));
    }
  });
  missing = over_ranks(*level.comm, missing);
  return {missing.count, missing.at, std::move(places)};
}

}  // namespace pnpbs
