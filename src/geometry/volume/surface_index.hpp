// SPDX-License-Identifier: BSD-3-Clause
// Geometric queries about the surfaces of a volume, whose triangles can be finer or coarser than d
// by any factor: inside or outside, nearest point, first intersection of a ray.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "geometry/facet_index.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

class SurfaceIndex {
 public:
  SurfaceIndex() = default;
  // Indexes the facets of a mesh, which must outlive this object.
  SurfaceIndex(const BoundaryMesh<3>& mesh, const Box<3>& bounds);

  // Returns whether x is strictly inside the domain, so not on a facet. The result is exact.
  bool inside(const Point<3>& x) const { return sides_.inside(x); }
  const FacetIndex<3>& sides() const { return sides_; }

  // Returns the nearest point of the facets if it is closer to x than `reach`. Otherwise the gap is
  // `reach` and the facet -1. Of facets at the same distance, the one with the smallest index is
  // returned.
  NearestPoint<3> nearest(const Point<3>& x, double reach) const;
  // Returns the gap of nearest().
  double clearance(const Point<3>& x, double reach) const { return nearest(x, reach).gap; }
  // Returns clearance(x, reach) if it is at most `exact`. Otherwise returns a lower bound of it,
  // which is larger than four fifths of it and at least `exact`. In the middle of a ball, where all
  // facets are about as near, this takes much less time.
  double least_clearance(const Point<3>& x, double exact, double reach) const;

  // The first facet other than `from` that the segment from x to x + way crosses.
  struct Hit {
    double along;  // Fraction of the segment.
    std::int32_t facet = -1;
  };
  Hit first_hit(const Point<3>& x, const Point<3>& way, std::int32_t from) const;

 private:
  // Two parallel planes that enclose the facets in a cell of boxes. Along a curved surface the slab
  // is much thinner than the bounding box, whose height is comparable to the width of the cell.
  struct Slab {
    Point<3> normal{};  // Unit vector, or 0 if the cell has no slab.
    double low = 0, high = 0;

    double gap_to(const Point<3>& x) const;
  };
  Slab slab_around(std::span<const std::int32_t> facets) const;
  template <class Limit>
  NearestPoint<3> nearest_within(const Point<3>& x, double reach, const Limit& limit) const;

  FacetIndex<3> sides_;      // Cells with few facets each, whatever d is.
  BoxTree<3> boxes_;         // Boxes of the facets.
  std::vector<Slab> slabs_;  // One per cell of boxes_.
};

}  // namespace pnpbs
