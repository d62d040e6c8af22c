// SPDX-License-Identifier: BSD-3-Clause
// The triangles of a surface on which all nodes agree. They are those that all three corners find,
// and a triangulation of each hole in between, which is a function of the hole alone. Therefore
// every triangle is in the stars of all its corners, on any rank.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/nodes.hpp"
#include "delaunay/volume/surface_rings.hpp"

namespace pnpbs {

class AgreedTriangles {
 public:
  // Maximum number of corners of a hole that is triangulated. Larger holes remain open.
  static constexpr std::size_t kMaxHole = 8;
  // Number of rings of neighbours that must be known for the triangles of a node: half the way
  // around a hole, and one more for the agreement.
  static constexpr int kRings = static_cast<int>(kMaxHole / 2) + 1;

  AgreedTriangles(const Nodes<3>& nodes, const SurfaceRings& rings)
      : nodes_(nodes), rings_(rings) {}

  // The two other corners of a triangle; (i, a, b) is counter-clockwise.
  using Others = std::array<std::int32_t, 2>;
  void of(std::int64_t i, std::vector<Others>& triangles);

 private:
  struct Gap {
    std::size_t begin, end;  // Entries of the ring between which the hole lies.
  };

  bool found_by(std::int32_t node, std::int64_t a, std::int64_t b) const;
  // Returns whether both other corners of the k-th triangle of node i find the triangle, too.
  bool is_agreed(std::int64_t i, std::size_t k) const;
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
  std::vector<std::int32_t> hole_;  // Corners of the current hole, counter-clockwise.
};

}  // namespace pnpbs
