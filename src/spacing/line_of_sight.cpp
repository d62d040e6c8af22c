// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/line_of_sight.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "domain/plane/boundary.hpp"
#include "geometry/plane/edges.hpp"
#include "geometry/volume/triangles.hpp"
#include "spacing/sized_tree.hpp"
#include "tree/cell_samples.hpp"

namespace pnpbs {

namespace {

template <int Dim>
Box<Dim> box_of(const Point<Dim>& a, const Point<Dim>& b) {
  Box<Dim> box;
  for (int k = 0; k < Dim; ++k) {
    box.low[k] = std::min(a[k], b[k]);
    box.high[k] = std::max(a[k], b[k]);
  }
  return box;
}

}  // namespace

template <int Dim>
LineOfSight<Dim>::LineOfSight(const Box<Dim>& bounds, double measure,
                              std::shared_ptr<const FacetIndex<Dim>> facets)
    : bounds_(bounds), measure_(measure), facets_(std::move(facets)) {
  const BackgroundTree<Dim>& tree = facets_->tree();
  has_facets_.assign(static_cast<std::size_t>(tree.cell_count()), 0);
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf)
    has_facets_[static_cast<std::size_t>(tree.leaf_cell(leaf))] = facets_->leaf_has_facets(leaf);
  // Cells are stored after their parents, so this loop visits children first.
  for (std::int32_t c = tree.cell_count() - 1; c >= 0; --c) {
    const std::int32_t first = tree.cell(c).first_child;
    for (int k = 0; first >= 0 && k < BackgroundTree<Dim>::kChildren; ++k)
      has_facets_[static_cast<std::size_t>(c)] |= has_facets_[static_cast<std::size_t>(first + k)];
  }
}

template <int Dim>
typename LineOfSight<Dim>::Side LineOfSight<Dim>::side_of(const Box<Dim>& box) const {
  bool crossed = false;
  facets_->tree().for_leaves_in(
      box,
      [&](std::int32_t cell) {
        return !crossed && has_facets_[static_cast<std::size_t>(cell)] != 0;
      },
      [&](std::int32_t leaf) {
        for (const std::int32_t f : facets_->facets_of_leaf(leaf))
          crossed = crossed || may_meet_box(facets_->corners(f), box);
      });
  if (crossed) return Side::crossed;
  return facets_->inside(middle_of<Dim>(box)) ? Side::inside : Side::outside;
}

template <int Dim>
Point<Dim> LineOfSight<Dim>::nearest_of_boundary(const Point<Dim>& x, double reach) const {
  // The nearest point is usually close, whereas thousands of facets may lie within `reach`. The
  // search radius therefore grows step by step.
  const BackgroundTree<Dim>& tree = facets_->tree();
  for (double near = tree.cell_side(tree.leaf_cell(tree.leaf_at(x)));; near *= 2) {
    const NearestPoint<Dim> nearest = facets_->nearest(x, std::min(near, reach));
    if (nearest.facet >= 0) return nearest.x;
    if (near >= reach) return x;
  }
}

template <int Dim>
bool LineOfSight<Dim>::open(const Point<Dim>& a, const Point<Dim>& b) const {
  bool open = true;
  const BackgroundTree<Dim>& tree = facets_->tree();
  tree.for_leaves_in(
      box_of<Dim>(a, b),
      [&](std::int32_t cell) {
        return open && has_facets_[static_cast<std::size_t>(cell)] != 0 &&
               segment_may_meet_box(a, b, tree.cell_box_with_room(cell));
      },
      [&](std::int32_t leaf) { open = open && !facets_->facet_between(leaf, a, b); });
  return open;
}

std::shared_ptr<const FacetIndex<2>> indexed_boundary(const PlaneDomain& domain,
                                                      const SpacingEvaluator<2>& d,
                                                      std::int64_t max_nodes) {
  struct Indexed {
    BoundaryMesh<2> boundary;
    SizedTree<2> map;  // refined by the boundary only
  };
  const auto indexed = std::make_shared<Indexed>();
  indexed->boundary = discretize_boundary(domain, d, max_nodes);
  const double wide = std::max(domain.bounds().high[0] - domain.bounds().low[0],
                               domain.bounds().high[1] - domain.bounds().low[1]);
  const SpacingEvaluator<2> nothing_fine = [wide](std::int64_t n, const Point<2>*, double* at) {
    std::fill(at, at + n, wide);
  };
  indexed->map.build(domain.bounds(), indexed->boundary, nothing_fine,
                     {std::numeric_limits<std::int64_t>::max()});
  return {indexed, &indexed->map};
}

std::shared_ptr<const FacetIndex<3>> indexed_boundary(const VolumeDomain& domain,
                                                      const SpacingEvaluator<3>&, std::int64_t) {
  return domain.sides();
}

template class LineOfSight<2>;
template class LineOfSight<3>;

}  // namespace pnpbs
