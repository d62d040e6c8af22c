// SPDX-License-Identifier: BSD-3-Clause
// A part of a triangulation with a value at each node, linear on each triangle: what one rank holds
// of a spacing that is given at nodes. Several patches make up the whole; of the answers that they
// give for a point the least one counts, so that it does not matter who holds what.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "tree/box_tree.hpp"

namespace pnpbs {

struct PatchNode {
  Point<2> x;
  std::int64_t id;
  double value;
};

struct Patch {
  std::vector<PatchNode> nodes;
  // Indices of nodes, by increasing id in each row.
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::array<std::int32_t, 2>> rim;  // edges with nothing on one side
};

struct PatchAnswer {
  double gap = std::numeric_limits<double>::infinity();  // squared distance to the triangle or edge
  std::array<std::int64_t, 3> ids{};                     // of the nodes the value comes from
  double value = 0;

  bool found() const { return gap < std::numeric_limits<double>::infinity(); }
  bool operator<(const PatchAnswer& other) const {
    return gap != other.gap ? gap < other.gap : ids < other.ids;
  }
};

class NodalPatch {
 public:
  NodalPatch() = default;
  explicit NodalPatch(Patch patch);

  // From the triangle that holds x; if several do (x on an edge or node), from the one of least
  // ids. Leaves `best` alone if none does.
  void interpolate(const Point<2>& x, PatchAnswer& best) const;
  // From the nearest point of the rim, if it is nearer than `best`.
  void extend(const Point<2>& x, PatchAnswer& best) const;

  std::vector<Box<2>> triangles_cover(std::size_t many) const { return by_triangle_.cover(many); }
  std::vector<Box<2>> rim_cover(std::size_t many) const { return by_edge_.cover(many); }

 private:
  const PatchNode& node(std::int32_t i) const { return patch_.nodes[static_cast<std::size_t>(i)]; }

  Patch patch_;
  BoxTree<2> by_triangle_, by_edge_;
};

}  // namespace pnpbs
