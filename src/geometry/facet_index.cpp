// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/facet_index.hpp"

#include <algorithm>
#include <utility>

#include "base/limits.hpp"
#include "geometry/plane/edges.hpp"
#include "geometry/volume/triangles.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

namespace {

constexpr double kRoom = 1e-12;  // of coordinates, for rounding

template <std::size_t Dim, std::size_t N>
Box<Dim> box_of(const std::array<std::array<double, Dim>, N>& corners) {
  Box<Dim> box{corners[0], corners[0]};
  for (std::size_t n = 1; n < N; ++n) include<Dim>(box, corners[n]);
  return box;
}

}  // namespace

template <int Dim>
FacetIndex<Dim>::FacetIndex(BackgroundTree<Dim> tree, const FacetCells<Dim>& cells)
    : tree_(std::move(tree)),
      room_(kRoom * farthest_coordinate<Dim>(tree_.cell_box(0))),
      boundary_(&cells.mesh()),
      corners_(cells.corners()),
      offset_{0} {
  blocks_.build(corners_);
  for (std::int32_t c = 0; c < cells.count(); ++c) cell_has_facets_.push_back(cells.crossed(c));
  for (std::int32_t leaf = 0; leaf < tree_.leaf_count(); ++leaf) {
    const std::int32_t c = tree_.leaf_cell(leaf);
    side_.push_back(side_of(cells, c));
    reference_.push_back(cells.reference(c));
    for (const std::int32_t f : cells.facets(c)) leaf_facets_.push_back(f);
    offset_.push_back(static_cast<std::int32_t>(leaf_facets_.size()));
  }
}

template <int Dim>
typename FacetIndex<Dim>::Side FacetIndex<Dim>::side_of(const FacetCells<Dim>& cells,
                                                        std::int32_t c) {
  if (cells.crossed(c)) return Side::crossed;
  if (!cells.outside(c)) return Side::inside;
  return cells.has_facets_beside(c) ? Side::beside : Side::outside;
}

template <int Dim>
bool FacetIndex<Dim>::inside_in_leaf(std::int32_t leaf, const Point<Dim>& x) const {
  if (side(leaf) != Side::crossed) return side(leaf) == Side::inside;
  const ReferencePoint<Dim>& from = reference_[index(leaf)];
  bool inside = from.inside;
  for (const std::int32_t f : facets_of_leaf(leaf)) {
    if (boxes_are_apart(from.x, x, corners(f))) continue;  // most are
    if (on_facet(corners(f), x)) return false;
    if (facet(f).bounds() && crosses(from.x, x, corners(f))) inside = !inside;
  }
  return inside;
}

template <int Dim>
bool FacetIndex<Dim>::on_inner_facet(const Point<Dim>& x) const {
  bool found = false;
  for (const std::int32_t f : facets_of_leaf(tree_.leaf_at(x))) {
    if (!on_facet(corners(f), x)) continue;
    if (facet(f).bounds()) return false;
    found = true;
  }
  return found;
}

template <int Dim>
bool FacetIndex<Dim>::facet_between(std::int32_t leaf, const Point<Dim>& a,
                                    const Point<Dim>& b) const {
  const std::span<const std::int32_t> facets = facets_of_leaf(leaf);
  return std::any_of(facets.begin(), facets.end(),
                     [&](std::int32_t f) { return crosses(a, b, corners(f)); });
}

// Most cells and facets are told by their boxes to be farther than what has been found; a cell may
// hold thousands of facets that meet in a node.
template <int Dim>
NearestPoint<Dim> FacetIndex<Dim>::nearest(const Point<Dim>& x, double reach) const {
  NearestPoint<Dim> best{reach};
  const auto may_be_as_near = [&](const Box<Dim>& box) {
    const double gap = best.gap + room_;
    return squared_gap_to(box, x) <= gap * gap;
  };
  const auto enter = [&](std::int32_t cell) {
    return cell_has_facets_[index(cell)] != 0 && may_be_as_near(tree_.cell_box(cell));
  };
  tree_.for_leaves_in(box_around<Dim>(x, reach), enter, [&](std::int32_t leaf) {
    for (const std::int32_t f : facets_of_leaf(leaf)) {
      if (!may_be_as_near(box_of(corners(f)))) continue;
      const Point<Dim> q = nearest_on(corners(f), x);
      const double gap = distance<Dim>(q, x);
      if (gap < best.gap || (gap == best.gap && f < best.facet)) best = {gap, f, q};
    }
  });
  return best;
}

template <int Dim>
double FacetIndex<Dim>::clearance(const Point<Dim>& x, double reach) const {
  return nearest(x, reach).gap;
}

template class FacetIndex<2>;
template class FacetIndex<3>;

}  // namespace pnpbs
