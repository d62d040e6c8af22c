// SPDX-License-Identifier: BSD-3-Clause
// The faces between tetrahedra that represent the surfaces inside a body.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "level/level.hpp"

namespace pnpbs {

// A face that represents an inner surface.
struct InnerFacet {
  // The one with the smallest id first; oriented like the surface.
  std::array<std::int64_t, 3> nodes;
  std::int32_t tag;  // of the surface
};

// Finds such faces around single nodes. A face represents an inner surface if its three nodes lie
// on the surface and its two tetrahedra lie on different sides of it, so that the segment between
// their centroids crosses it. The segments around an edge of these faces form a ring, which crosses
// a surface without a border an even number of times. Therefore the faces leave no gap.
// The restricted Delaunay triangulation (H. Edelsbrunner, N. R. Shah, Int. J. Comput. Geom. Appl. 7
// (1997) 365-378) uses the segment between circumcentres instead. The two agree for tetrahedra with
// their fourth node off the surface. If all four nodes lie on it, the tetrahedron is flat and its
// circumcentre can be anywhere.
class InnerFacets {
 public:
  explicit InnerFacets(const Level<3>& level);

  // Returns whether the body has inner surfaces.
  bool any() const { return any_; }
  // Returns the faces whose node with the smallest id is node i. They are the same on every rank
  // that has the star of node i. The reference is valid until the next call.
  const std::vector<InnerFacet>& at(std::int64_t i);
  // Returns all such faces of node i, likewise.
  const std::vector<InnerFacet>& around(std::int64_t i);
  // Returns the area of the faces of all ranks over that of the inner surfaces. Collective;
  // requires inner surfaces, and the stars of all owned nodes.
  double covered_share();

 private:
  // A face of node i together with one of its two tetrahedra.
  struct Face {
    std::array<std::int64_t, 3> ids;    // ascending
    std::array<std::int64_t, 3> nodes;  // memory indices, in the order of ids
    std::int64_t apex;                  // id of the fourth node of the tetrahedron
    Point<3> centroid;
  };

  const std::vector<InnerFacet>& find(std::int64_t i, bool least_only);
  bool on_patch(std::int64_t i, std::int32_t patch) const;
  std::int32_t crossed_facet(const Point<3>& from, const Point<3>& to);
  void judge(const Face& one, const Face& other);

  const Level<3>& level_;
  bool any_ = false;
  std::vector<Face> faces_;
  std::vector<std::int32_t> crossed_;
  std::vector<InnerFacet> found_;
};

}  // namespace pnpbs
