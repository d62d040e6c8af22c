// SPDX-License-Identifier: BSD-3-Clause
// The cells of a lattice that the surface of a level set goes through. They are found on an octree:
// cells are cut in eight where the signs of f at corners and centre differ, where the differences
// of f there say that it may be 0 between, and next to a face in which signs differ. So f is asked
// near the surface only, and small bodies far from others can be missed where f does not fall
// towards them. Where the box has no extent in z, they are squares of a lattice in the plane.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "implicit/level_set.hpp"

namespace pnpbs {

// Coordinates of a lattice point, or of a cell by its lowest corner.
using LatticePlace = std::array<std::int32_t, 3>;

class LevelSetLattice {
 public:
  // Throws Error(ErrorKind::domain) if f is negative nowhere, or on the border of the box.
  explicit LevelSetLattice(const LevelSet& set);

  // Those of the finest cells that have corners with f < 0 and others, in a fixed order.
  const std::vector<LatticePlace>& crossed() const { return crossed_; }
  Point<3> position(const LatticePlace& place) const;
  // At a corner of a crossed cell.
  double value(const LatticePlace& place) const { return samples_.at(key(place)); }

  // Distinct for places with coordinates from 0 to 2^20.
  static std::uint64_t key(const LatticePlace& place) {
    return std::uint64_t(place[2]) << 42 | std::uint64_t(place[1]) << 21 | std::uint64_t(place[0]);
  }
  static LatticePlace place(std::uint64_t key);

 private:
  // Of the cells of one depth, whose sides are 2^depth lattice steps: but for those at the far ends
  // of the box, which it may cut off.
  struct Depth {
    int depth;
    std::vector<std::uint64_t> cells;
    std::vector<char> crossed, near;  // near: f may be 0 in it
  };

  bool is_flat(std::size_t axis) const;
  Depth coarsest() const;
  void judge(Depth& at);
  void flood(Depth& at);
  Depth next(const Depth& coarser) const;

  LatticePlace corner(const LatticePlace& cell, int depth, int which) const;
  LatticePlace centre(const LatticePlace& cell, int depth) const;
  bool face_crossed(const LatticePlace& cell, int depth, std::size_t axis, bool high) const;
  void sample(int depth, std::span<const std::uint64_t> cells);
  void reject_border(const LatticePlace& place) const;

  const LevelSet& set_;
  LatticePlace cells_;  // in each direction
  std::unordered_map<std::uint64_t, double> samples_;
  std::size_t asked_ = 0;
  std::vector<LatticePlace> crossed_;
};

}  // namespace pnpbs
