// SPDX-License-Identifier: BSD-3-Clause
// Which faces between tetrahedra stand for the surfaces inside of a body.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "level/level.hpp"

namespace pnpbs {

struct InnerFacet {
  std::array<std::int64_t, 3> nodes;  // that of the least id first; they turn as the surface does
  std::int32_t tag;                   // of the surface there
};

// Finds them around one node after the other: the faces whose three nodes lie on one inner surface
// and whose tetrahedra lie on two sides of it, so that the way between their centroids crosses it.
// Around an edge of these faces ways go round in a ring, which crosses a surface without a border
// there an even number of times: the triangles leave no gap.
//
// The restricted Delaunay triangulation (H. Edelsbrunner, N. R. Shah, Int. J. Comput. Geom. Appl. 7
// (1997) 365-378) asks for the way between circumcentres. For tetrahedra that have their fourth
// node off the surface that is the same; of flat ones, whose four nodes lie on it, circumcentres
// are anywhere.
class InnerFacets {
 public:
  explicit InnerFacets(const Level<3>& level);

  // Is there a surface inside?
  bool any() const { return any_; }
  // Those of which node i is the one with the least id: the same on every rank that has its star.
  const std::vector<InnerFacet>& at(std::int64_t i);

 private:
  // A face of node i and one of the tetrahedra that have it.
  struct Face {
    std::array<std::int64_t, 2> ids;    // of the other two nodes, ascending
    std::array<std::int64_t, 3> nodes;  // in the order of their ids
    std::int64_t apex;                  // the tetrahedron's fourth node, by its id
    Point<3> centroid;
  };

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
