// SPDX-License-Identifier: BSD-3-Clause
// Stars of a volume's nodes while some of these go elsewhere, one at a time: the stars made before,
// and over them those that have changed since then.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "base/nodes.hpp"
#include "delaunay/volume/volume_stars.hpp"

namespace pnpbs {

// Its corners, by id where that is said, so that what is computed from them is the same everywhere.
using TetrahedronNodes = std::array<std::int32_t, 4>;

// Without the call of memcmp that comparing arrays is.
template <std::size_t N>
bool same(const std::array<std::int32_t, N>& a, const std::array<std::int32_t, N>& b) {
  std::int32_t differing = 0;
  for (std::size_t k = 0; k < N; ++k) differing |= a[k] ^ b[k];
  return differing == 0;
}
template <std::size_t N>
auto find_same(std::vector<std::array<std::int32_t, N>>& list,
               const std::array<std::int32_t, N>& corners) {
  return std::find_if(list.begin(), list.end(), [&](const auto& c) { return same(c, corners); });
}
template <std::size_t N>
bool contains(const std::vector<std::array<std::int32_t, N>>& list,
              const std::array<std::int32_t, N>& corners) {
  return std::any_of(list.begin(), list.end(), [&](const auto& c) { return same(c, corners); });
}

// What becomes of the triangulation if a node goes to x.
struct StarChange {
  std::int32_t node;
  Point<3> x;
  std::vector<TetrahedronNodes> gone, made;  // of positive orientation
  std::int32_t on = -1;                      // of a node on a surface: its facet there
};

class StarChanges {
 public:
  using Corners = std::array<std::int32_t, 3>;

  StarChanges(const Nodes<3>& nodes, const VolumeStars& stars, bool on_surfaces_too = false)
      : nodes_(nodes),
        stars_(stars),
        on_surfaces_too_(on_surfaces_too),
        place_(static_cast<std::size_t>(nodes.count), kUnchanged) {}

  // As those of VolumeStars, in some order.
  template <class Visit>
  void for_neighbours(std::int64_t i, const Visit& visit) const {
    const std::int32_t place = place_[static_cast<std::size_t>(i)];
    if (place == kUnchanged) return stars_.for_neighbours(i, visit);
    for (const std::int32_t j : changed_[static_cast<std::size_t>(place)].neighbours)
      visit(static_cast<std::int64_t>(j));
  }
  template <class Visit>
  void for_simplices(std::int64_t i, const Visit& visit) const {
    const std::int32_t place = place_[static_cast<std::size_t>(i)];
    if (place == kUnchanged) return stars_.for_simplices(i, visit);
    for (const Corners& corners : changed_[static_cast<std::size_t>(place)].simplices)
      visit(corners);
  }

  // May it go elsewhere?
  bool movable(std::int64_t i) const {
    return nodes_.moves(i) || (on_surfaces_too_ && nodes_.carrier(i) == Carrier::surface);
  }
  // Only tetrahedra with such a node can be mended.
  bool any_movable(const TetrahedronNodes& tetrahedron) const {
    return std::any_of(tetrahedron.begin(), tetrahedron.end(),
                       [this](std::int32_t i) { return movable(i); });
  }
  // Calls visit(tetrahedron) for those around node i that have it for the first by id of all
  // corners that count: so each once, of those around all nodes that do.
  template <class Counts, class Visit>
  void for_simplices_first_at(std::int64_t i, const Counts& counts, const Visit& visit) const {
    const std::int64_t id = nodes_.id(i);
    for_simplices(i, [&](const Corners& corners) {
      for (const std::int32_t j : corners)
        if (nodes_.id(j) < id && counts(j)) return;
      visit(TetrahedronNodes{static_cast<std::int32_t>(i), corners[0], corners[1], corners[2]});
    });
  }
  // The same triangle has the same corners in the same turn, whichever comes first.
  static Corners least_first(const Corners& c);
  TetrahedronNodes by_id(TetrahedronNodes corners) const;
  bool ids_less(const TetrahedronNodes& a, const TetrahedronNodes& b) const;

  // The nodes have gone there. Of two such changes no tetrahedra have a corner in common. Returns,
  // of each, the nodes whose stars have changed.
  std::vector<std::vector<std::int32_t>> accept(std::span<const StarChange> changes);

  // Who decides by the star of node i counts it if that need not be right: it is neither an owned
  // node's nor one that was found.
  void count_if_unknown(std::int64_t i) const {
    if (!nodes_.owned(i) && !stars_.found(i))
      std::atomic_ref<std::int64_t>(unknown_uses_).fetch_add(1, std::memory_order_relaxed);
  }
  std::int64_t unknown_uses() const { return unknown_uses_; }

  // Puts the stars that have changed in place of those made before, which these are.
  void write_to(VolumeStars& stars) const;

 private:
  struct Star {
    std::vector<std::int32_t> neighbours;
    std::vector<Corners> simplices;
  };

  static constexpr std::int32_t kUnchanged = -1;

  Star star_after(std::int32_t i, const StarChange& change) const;
  void put(std::int32_t i, Star star);
  void write_in_order(const Star& star, std::vector<std::int32_t>& out) const;

  const Nodes<3>& nodes_;
  const VolumeStars& stars_;
  bool on_surfaces_too_;
  std::vector<std::int32_t> place_;  // of each node's star among those changed
  std::vector<Star> changed_;
  mutable std::int64_t unknown_uses_ = 0;  // a tally of those who ask, which decides nothing
};

}  // namespace pnpbs
