// SPDX-License-Identifier: BSD-3-Clause
// The edges of a triangulation, and the triangles that meet in each.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/warning.hpp"
#include "surfaces/triangulation.hpp"

namespace pnpbs {

// A triangle at an edge: its edge from corner k to the next one.
struct EdgeSide {
  std::int32_t triangle;
  std::int32_t k;
  bool forward;  // from the lower vertex to the higher?

  std::int64_t corner() const { return 3 * std::int64_t{triangle} + k; }
};

class SurfaceEdges {
 public:
  explicit SurfaceEdges(const Triangulation& surface);

  std::size_t count() const { return ends_.size(); }
  // Its vertices, the lower one first. Edges come in the order of these.
  const std::array<std::int32_t, 2>& ends(std::size_t e) const { return ends_[e]; }
  // Those of boundary surfaces first, then those of inner ones, both in ascending order.
  std::span<const EdgeSide> sides(std::size_t e) const {
    return {sides_.data() + first_[e], sides_.data() + first_[e + 1]};
  }
  std::span<const EdgeSide> boundary_sides(std::size_t e) const {
    return {sides_.data() + first_[e], sides_.data() + first_inner_[e]};
  }
  std::span<const EdgeSide> inner_sides(std::size_t e) const {
    return {sides_.data() + first_inner_[e], sides_.data() + first_[e + 1]};
  }

 private:
  std::vector<std::array<std::int32_t, 2>> ends_;
  std::vector<std::size_t> first_, first_inner_;
  std::vector<EdgeSide> sides_;
};

enum class OneSided { rejected, ignored };

// Turns triangles so that they agree with their neighbours, the fewer ones of each connected
// surface, and warns if there are any. `edges` are changed accordingly. Where a surface has but one
// side, it throws Error(ErrorKind::domain), or some neighbours do not agree.
void orient_surfaces(Triangulation& surface, SurfaceEdges& edges, OneSided one_sided,
                     std::vector<Warning>& warnings);

}  // namespace pnpbs
