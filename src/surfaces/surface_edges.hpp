// SPDX-License-Identifier: BSD-3-Clause
// The edges of a triangulation, and the triangles at each edge.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/union_find.hpp"
#include "base/warning.hpp"
#include "surfaces/triangulation.hpp"

namespace pnpbs {

// A triangle at an edge, which is its edge from corner k to the next one.
struct EdgeSide {
  std::int32_t triangle;
  std::int32_t k;
  bool forward;  // true from the lower vertex to the higher

  std::int64_t corner() const { return 3 * std::int64_t{triangle} + k; }
};

// All edges of a triangulation, ordered by their vertices.
class SurfaceEdges {
 public:
  explicit SurfaceEdges(const Triangulation& surface);

  std::size_t count() const { return ends_.size(); }
  // Returns the vertices of the edge, the lower one first.
  const std::array<std::int32_t, 2>& ends(std::size_t e) const { return ends_[e]; }
  // Returns the triangles at the edge: boundary triangles first, then inner ones, both ascending.
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

// Returns the sets of triangles that are connected by edges.
UnionFind<std::int32_t> connected_triangles(const Triangulation& surface,
                                            const SurfaceEdges& edges);

// How orient_surfaces() treats one-sided surfaces such as Moebius strips.
enum class OneSided { rejected, ignored };

// Turns triangles so that neighbours have the same orientation. In each connected surface the
// minority is turned, with a warning. Updates `edges`. On a one-sided surface, throws
// Error(ErrorKind::domain), or leaves some neighbours inconsistent if `one_sided` is `ignored`.
void orient_surfaces(Triangulation& surface, SurfaceEdges& edges, OneSided one_sided,
                     std::vector<Warning>& warnings);

}  // namespace pnpbs
