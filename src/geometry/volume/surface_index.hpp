// SPDX-License-Identifier: BSD-3-Clause
// What is asked of the surfaces of a volume, which may be far finer than d, or coarser: inside and
// outside, the nearest point.
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
  // The mesh must outlive it.
  SurfaceIndex(const BoundaryMesh<3>& mesh, const Box<3>& bounds);

  // Is x strictly inside the domain? (On a facet: no.) Exact.
  bool inside(const Point<3>& x) const { return sides_.inside(x); }
  const FacetIndex<3>& sides() const { return sides_; }

  // The nearest point of the facets, if it is nearer to x than `reach`; else its gap is `reach`. Of
  // facets equally near, that of the least index.
  NearestPoint<3> nearest(const Point<3>& x, double reach) const;
  // Its gap alone.
  double clearance(const Point<3>& x, double reach) const { return nearest(x, reach).gap; }

  // The first facet that the straight way from x by `way` crosses, other than `from`.
  struct Hit {
    double along;  // share of the way
    std::int32_t facet = -1;
  };
  Hit first_hit(const Point<3>& x, const Point<3>& way, std::int32_t from) const;

 private:
  // Two planes between which the facets in a cell of boxes lie. Across a curved surface the slab
  // between them is far thinner than the box, which stands out by as much as the cell is wide.
  struct Slab {
    Point<3> normal{};  // unit, or 0 where the cell has none
    double low = 0, high = 0;

    double gap_to(const Point<3>& x) const;
  };
  Slab slab_around(std::span<const std::int32_t> facets) const;

  FacetIndex<3> sides_;      // cells that hold few facets each, whatever d is
  BoxTree<3> boxes_;         // of the facets
  std::vector<Slab> slabs_;  // of the cells of boxes
};

}  // namespace pnpbs
