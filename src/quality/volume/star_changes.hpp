// SPDX-License-Identifier: BSD-3-Clause
// Stars of the nodes of a volume while single nodes move. Stars that have changed are stored on top
// of the original ones.
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

// Local indices of the corners of a tetrahedron. Where stated, they are sorted by id, so that
// results computed from them have the same bits on every rank.
using TetrahedronNodes = std::array<std::int32_t, 4>;

// Compares arrays without the call of memcmp that operator== compiles to.
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

// The change of the triangulation when a node moves to x.
struct StarChange {
  std::int32_t node;
  Point<3> x;
  std::vector<TetrahedronNodes> gone, made;  // positively oriented
  std::int32_t on = -1;                      // new facet of a node on a surface, or -1
};

// Original stars and the changes made to them. `nodes` and `stars` must outlive this object.
class StarChanges {
 public:
  using Corners = std::array<std::int32_t, 3>;

  // Starts without changes. Nodes on surfaces are movable as well if `on_surfaces_too` is true.
  StarChanges(const Nodes<3>& nodes, const VolumeStars& stars, bool on_surfaces_too = false)
      : nodes_(nodes),
        stars_(stars),
        on_surfaces_too_(on_surfaces_too),
        place_(static_cast<std::size_t>(nodes.count), kUnchanged) {}

  // These two functions visit the same as those of VolumeStars, but in an unspecified order.
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

  // Returns whether the repair may move node i.
  bool movable(std::int64_t i) const {
    return nodes_.moves(i) || (on_surfaces_too_ && nodes_.carrier(i) == Carrier::surface);
  }
  // Returns whether any corner is movable. Other tetrahedra cannot be repaired.
  bool any_movable(const TetrahedronNodes& tetrahedron) const {
    return std::any_of(tetrahedron.begin(), tetrahedron.end(),
                       [this](std::int32_t i) { return movable(i); });
  }
  // Calls visit(tetrahedron) for the tetrahedra around node i in which i has the smallest id of all
  // corners j with counts(j). Over all counting nodes i, each tetrahedron is visited once.
  template <class Counts, class Visit>
  void for_simplices_first_at(std::int64_t i, const Counts& counts, const Visit& visit) const {
    const std::int64_t id = nodes_.id(i);
    for_simplices(i, [&](const Corners& corners) {
      for (const std::int32_t j : corners)
        if (nodes_.id(j) < id && counts(j)) return;
      visit(TetrahedronNodes{static_cast<std::int32_t>(i), corners[0], corners[1], corners[2]});
    });
  }
  // Rotates the corners so that the smallest index comes first. The orientation is kept.
  static Corners least_first(const Corners& c);
  // Sorts the corners by id. The orientation is lost.
  TetrahedronNodes by_id(TetrahedronNodes corners) const;
  // Compares two tetrahedra lexicographically by the ids of their corners.
  bool ids_less(const TetrahedronNodes& a, const TetrahedronNodes& b) const;

  // Applies the changes. Tetrahedra of different changes must not share corners. Returns the nodes
  // whose stars changed, for each change.
  std::vector<std::vector<std::int32_t>> accept(std::span<const StarChange> changes);

  // Counts a use of the star of node i if this star may be wrong, because the node is a ghost
  // without a computed star. The caller must call this before it decides by the star.
  void count_if_unknown(std::int64_t i) const {
    if (!nodes_.owned(i) && !stars_.found(i))
      std::atomic_ref<std::int64_t>(unknown_uses_).fetch_add(1, std::memory_order_relaxed);
  }
  std::int64_t unknown_uses() const { return unknown_uses_; }

  // Writes the changed stars to `stars`, which must be the original ones.
  void write_to(VolumeStars& stars) const;

 private:
  // A changed star: neighbours of a node, and its tetrahedra by their other three corners.
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
  std::vector<std::int32_t> place_;  // index in changed_ for each node, or kUnchanged
  std::vector<Star> changed_;
  mutable std::int64_t unknown_uses_ = 0;  // a counter that influences no decision
};

}  // namespace pnpbs
