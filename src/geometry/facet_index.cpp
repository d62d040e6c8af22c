// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/facet_index.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "base/limits.hpp"
#include "geometry/plane/edges.hpp"
#include "geometry/volume/triangles.hpp"
#include "tree/box_tree.hpp"
#include "tree/cell_samples.hpp"

namespace pnpbs {
namespace {

// Relative position of the first candidate for a reference point in its cell, and the steps to
// further candidates if the first lies on a facet. [side of the cell]
constexpr double kFirstReference[3] = {0.41421356, 0.57721566, 0.69314718};
constexpr double kReferenceSteps[3] = {0.6180339887, 0.7548776662, 0.8191725134};

}  // namespace

template <int Dim>
FacetCells<Dim>::FacetCells(const BoundaryMesh<Dim>& mesh) : mesh_(mesh) {
  corners_.reserve(mesh.facets.size());
  for (const auto& facet : mesh.facets) corners_.push_back(corners_of(mesh, facet));
  blocks_.build(corners_);
}

template <int Dim>
void FacetCells<Dim>::add_root(const BackgroundTree<Dim>& tree) {
  // Strictly outside the bounding box of the domain. The root of a periodic domain begins at it.
  Point<Dim> outside = tree.origin();
  if (tree.periodic_cell().any())
    for (double& x : outside) x -= tree.side() / 2048;
  references_.push_back({outside, false});
  facets_.resize(corners_.size());
  std::iota(facets_.begin(), facets_.end(), 0);
  offset_.push_back(facets_.size());
  if (mesh_.node_distance > 0) {
    beside_ = facets_;
    beside_offset_ = offset_;
  }
}

namespace {

template <std::size_t Dim, std::size_t N>
Box<Dim> box_of(const std::array<std::array<double, Dim>, N>& corners) {
  Box<Dim> box{corners[0], corners[0]};
  for (std::size_t n = 1; n < N; ++n) include<Dim>(box, corners[n]);
  return box;
}

template <int Dim>
bool holds_corner(const Box<Dim>& box, const FacetCorners<Dim>& corners) {
  return std::ranges::any_of(corners,
                             [&](const Point<Dim>& x) { return in_closed_box<Dim>(box, x); });
}

}  // namespace

// Appends the facets of the parent that may meet the box. Corners and boxes decide most cases.
template <int Dim>
void FacetCells<Dim>::inherit(std::int32_t parent, const Box<Dim>& box,
                              std::vector<std::int32_t>& facets,
                              std::vector<std::size_t>& offset) const {
  const std::vector<std::int32_t> row(
      facets.begin() + static_cast<std::ptrdiff_t>(offset[index(parent)]),
      facets.begin() + static_cast<std::ptrdiff_t>(offset[index(parent) + 1]));
  blocks_.for_facets(
      row, [&](const Box<Dim>& block) { return !boxes_meet(block, box); },
      [&](std::int32_t f) {
        const FacetCorners<Dim>& corners = corners_[index(f)];
        if (holds_corner<Dim>(box, corners) || may_meet_box(corners, box)) facets.push_back(f);
      });
  offset.push_back(facets.size());
}

template <int Dim>
void FacetCells<Dim>::add_children(const BackgroundTree<Dim>& tree, std::int32_t parent) {
  const std::int32_t first = tree.cell(parent).first_child;
  for (std::int32_t c = first; c < first + BackgroundTree<Dim>::kChildren; ++c) {
    const Box<Dim> room = tree.cell_box_with_room(c);
    inherit(parent, room, facets_, offset_);
    if (mesh_.node_distance > 0)
      inherit(parent, widened(room, mesh_.node_distance), beside_, beside_offset_);
    references_.push_back(reference_in(tree.cell_box(c), parent));
  }
}

template <int Dim>
ReferencePoint<Dim> FacetCells<Dim>::reference_in(const Box<Dim>& box, std::int32_t parent) const {
  Point<Dim> fraction;
  std::copy_n(kFirstReference, Dim, fraction.begin());
  while (true) {
    const Point<Dim> x = point_in<Dim>(box, fraction);
    if (!on_facet_of(parent, x)) return {x, inside(parent, x)};
    for (std::size_t k = 0; k < Dim; ++k)
      fraction[k] = std::fmod(fraction[k] + kReferenceSteps[k], 1.0);
  }
}

template <int Dim>
bool FacetCells<Dim>::on_facet_of(std::int32_t c, const Point<Dim>& x) const {
  bool found = false;
  blocks_.for_facets(
      facets(c), [&](const Box<Dim>& block) { return !in_closed_box(block, x); },
      [&](std::int32_t f) { found = found || on_facet(corners_[index(f)], x); });
  return found;
}

template <int Dim>
bool FacetCells<Dim>::inside(std::int32_t c, const Point<Dim>& x) const {
  const ReferencePoint<Dim>& from = reference(c);
  bool inside = from.inside;
  const Box<Dim> way = joined(Box<Dim>{x, x}, {from.x, from.x});
  blocks_.for_facets(
      facets(c), [&](const Box<Dim>& block) { return !boxes_meet(block, way); },
      [&](std::int32_t f) {
        if (mesh_.facets[index(f)].bounds() && crosses(from.x, x, corners_[index(f)]))
          inside = !inside;
      });
  return inside;
}

template class FacetCells<2>;
template class FacetCells<3>;

namespace {

constexpr double kRoom = 1e-12;  // Rounding error. [largest coordinate]

}  // namespace

template <int Dim>
FacetIndex<Dim>::FacetIndex(BackgroundTree<Dim> tree, const FacetCells<Dim>& cells)
    : tree_(std::move(tree)),
      room_(kRoom * farthest_coordinate<Dim>(tree_.cell_box(0))),
      boundary_(&cells.mesh()),
      corners_(cells.corners()),
      blocks_(cells.blocks()),
      offset_{0} {
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
    if (boxes_are_apart(from.x, x, corners(f))) continue;  // Excludes most facets.
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

// Boxes exclude most cells and facets. This matters because a cell can contain thousands of facets
// that meet in a node.
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

template <int Dim>
FacetIndex<Dim> index_facets(const BoundaryMesh<Dim>& mesh, const Box<Dim>& bounds) {
  constexpr std::size_t kMaxFacets = 32;
  constexpr int kMaxDepth = 16;  // Limits the depth where more than kMaxFacets meet in a node.
  FacetCells<Dim> facets(mesh);
  std::int32_t parents = 0;  // First cell of the previous depth.
  const auto add_children_before = [&](const BackgroundTree<Dim>& tree, std::int32_t last) {
    for (std::int32_t parent = parents; parent < last; ++parent)
      if (tree.cell(parent).first_child >= 0) facets.add_children(tree, parent);
    parents = last;
  };
  BackgroundTree<Dim> tree;
  tree.build(bounds, [&](const BackgroundTree<Dim>& grown, std::int32_t first, std::int32_t last,
                         std::vector<char>& split) {
    if (first == 0) facets.add_root(grown);
    add_children_before(grown, first);
    for (std::int32_t c = first; c < last; ++c)
      split[static_cast<std::size_t>(c - first)] =
          grown.cell(c).depth < kMaxDepth && facets.facets(c).size() > kMaxFacets;
  });
  add_children_before(tree, tree.cell_count());
  return FacetIndex<Dim>(std::move(tree), facets);
}

template FacetIndex<2> index_facets(const BoundaryMesh<2>&, const Box<2>&);
template FacetIndex<3> index_facets(const BoundaryMesh<3>&, const Box<3>&);

}  // namespace pnpbs
