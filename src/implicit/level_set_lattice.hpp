// SPDX-License-Identifier: BSD-3-Clause
// Finds the cells of a lattice that the surface of a level set crosses, by an octree. A cell is
// divided if f has different signs at its corners and centre, if their differences indicate that f
// may be 0 inside, or next to a face with different signs. Thus f is evaluated only near the
// surface. Small bodies far from others can be missed if f does not decrease towards them. If the
// box has no extent in z, cells are squares of a plane lattice.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "implicit/level_set.hpp"

namespace pnpbs {

// Index triple of a lattice point, or of a cell by its lowest corner.
using LatticeIndex = std::array<std::int32_t, 3>;

// The crossed cells of the lattice, with f at their corners.
class LevelSetLattice {
 public:
  // Evaluates f. Throws Error(ErrorKind::domain) if f is negative nowhere, or on the border of the
  // box.
  explicit LevelSetLattice(const LevelSet& set);

  // Returns the finest cells with f < 0 at some corners but not at all, in a fixed order.
  const std::vector<LatticeIndex>& crossed() const { return crossed_; }
  Point<3> position(const LatticeIndex& place) const;
  // Returns f at a corner of a crossed cell.
  double value(const LatticeIndex& place) const { return samples_.at(key(place)); }

  // Returns a key that is unique for indices from 0 to 2^20.
  static std::uint64_t key(const LatticeIndex& place) {
    return std::uint64_t(place[2]) << 42 | std::uint64_t(place[1]) << 21 | std::uint64_t(place[0]);
  }
  static LatticeIndex place(std::uint64_t key);

 private:
  // The cells of one depth. Their sides have 2^depth lattice steps, except where the far end of the
  // box cuts them.
  struct Depth {
    int depth;
    std::vector<std::uint64_t> cells;
    std::vector<char> crossed, near;  // near: f may be 0 in the cell
  };

  bool is_flat(std::size_t axis) const;
  Depth coarsest() const;
  void judge(Depth& at);
  void flood(Depth& at);
  Depth next(const Depth& coarser) const;

  LatticeIndex corner(const LatticeIndex& cell, int depth, int which) const;
  LatticeIndex centre(const LatticeIndex& cell, int depth) const;
  bool face_crossed(const LatticeIndex& cell, int depth, std::size_t axis, bool high) const;
  void sample(int depth, std::span<const std::uint64_t> cells);
  void reject_border(const LatticeIndex& place) const;

  const LevelSet& set_;
  LatticeIndex cells_;  // number of cells in each direction
  std::unordered_map<std::uint64_t, double> samples_;
  std::size_t asked_ = 0;
  std::vector<LatticeIndex> crossed_;
};

}  // namespace pnpbs
