// SPDX-License-Identifier: BSD-3-Clause
// The triangles of a surface on which all nodes agree: those that all three corners find, and in
// the holes that are left, where they do not, a triangulation that is a function of the hole alone.
// So every triangle is in the stars of all its corners, on any rank.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/nodes.hpp"
#include "delaunay/volume/surface_rings.hpp"

namespace pnpbs {

class AgreedTriangles {
 public:
  // Holes of more corners stay open.
  static constexpr std::size_t kMaxHole = 8;
  // So many neighbours away the rings must be known for a node's triangles: half around a hole, and
  // one more to agree.
  static constexpr int kRings = static_cast<int>(kMaxHole / 2) + 1;

  AgreedTriangles(const Nodes<3>& nodes, const SurfaceRings& rings)
      : nodes_(nodes), rings_(rings) {}

  // Triangle (i, a, b) turns counter-clockwise.
  using Others = std::array<std::int32_t, 2>;
  void of(std::int64_t i, std::vector<Others>& triangles);

 private:
  struct Gap {
    std::size_t begin, end;  // entries of the ring: the hole lies between them
  };

  bool found_by(std::int32_t node, std::int64_t a, std::int64_t b) const;
  bool collective_try(std::int64_t i, std::size_t k) const;
  void find_gaps(std::int64_t i, std::vector<Gap>& gaps) const;
  std::int32_t next_around_hole(std::int32_t node, std::int64_t from);
  bool walk_around_hole(std::int64_t i, const Gap& gap);
  void begin_with_least_id();
  void cut_ears(std::int64_t i, std::vector<Others>& triangles);
  double ear_quality(std::size_t k, const Point<3>& normal) const;
  Point<3> hole_normal() const;
  void add_with(std::int64_t i, const std::array<std::int32_t, 3>& triangle,
                std::vector<Others>& triangles) const;

  const Nodes<3>& nodes_;
  const SurfaceRings& rings_;
  std::vector<Gap> gaps_, gaps_there_;
  std::vector<std::int32_t> hole_;  // its corners, counter-clockwise
};

}  // namespace pnpbs
