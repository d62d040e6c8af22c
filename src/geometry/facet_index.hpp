// SPDX-License-Identifier: BSD-3-Clause
// The facets of the boundary by the leaves of a background tree, and on which side of them the
// leaves lie. Answers "is x inside?" and "which facets are near x?".
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/boundary_mesh.hpp"
#include "geometry/facet_blocks.hpp"
#include "geometry/facet_cells.hpp"
#include "tree/background_tree.hpp"

namespace pnpbs {

template <int Dim>
struct NearestPoint {
  double gap;               // distance to it
  std::int32_t facet = -1;  // that it lies on; -1: none was near enough
  Point<Dim> x{};
};

template <int Dim>
class FacetIndex {
 public:
  FacetIndex() = default;
  // Of all cells of the tree. The mesh must outlive it.
  FacetIndex(BackgroundTree<Dim> tree, const FacetCells<Dim>& cells);

  const BackgroundTree<Dim>& tree() const { return tree_; }
  // How far rounding may put a place off, generously.
  double room() const { return room_; }
  const BoundaryMesh<Dim>& boundary() const { return *boundary_; }

  bool leaf_outside(std::int32_t leaf) const {
    return side(leaf) == Side::outside || side(leaf) == Side::beside;
  }
  // Can no nodes be in it? Those of level sets may be in leaves outside, beside a facet.
  bool leaf_empty(std::int32_t leaf) const { return side(leaf) == Side::outside; }
  bool leaf_has_facets(std::int32_t leaf) const {
    return offset_[index(leaf)] < offset_[index(leaf) + 1];
  }
  // Those that meet the leaf, in the order of their indices.
  std::span<const std::int32_t> facets_of_leaf(std::int32_t leaf) const {
    const std::int32_t* const all = leaf_facets_.data();
    return {all + offset_[index(leaf)], all + offset_[index(leaf) + 1]};
  }

  // Is x strictly inside the domain? (On a facet: no.)
  bool inside(const Point<Dim>& x) const { return inside_in_leaf(tree_.leaf_at(x), x); }
  bool inside_in_leaf(std::int32_t leaf, const Point<Dim>& x) const;
  // Does x lie exactly on a facet that has the domain on both sides, and on none that bounds it?
  bool on_inner_facet(const Point<Dim>& x) const;

  // Calls visit(facet index) for every facet that may come within `reach` of x; a facet can come
  // more than once.
  template <class Visit>
  void for_facets_near(const Point<Dim>& x, double reach, const Visit& visit) const {
    const auto has_facets = [this](std::int32_t cell) {
      return cell_has_facets_[index(cell)] != 0;
    };
    tree_.for_leaves_in(box_around<Dim>(x, reach), has_facets, [&](std::int32_t leaf) {
      for (const std::int32_t f : facets_of_leaf(leaf)) visit(f);
    });
  }

  // Does the straight way from a to b cross a facet of the leaf? Not where it ends on one.
  bool facet_between(std::int32_t leaf, const Point<Dim>& a, const Point<Dim>& b) const;

  const FacetCorners<Dim>& corners(std::int32_t f) const { return corners_[index(f)]; }
  const BoundaryFacet<Dim>& facet(std::int32_t f) const { return boundary_->facets[index(f)]; }
  const FacetBlocks<Dim>& facet_blocks() const { return blocks_; }

  // The nearest point of the facets, if it is nearer to x than `reach`; else its gap is `reach`. Of
  // facets equally near, that of the least index.
  NearestPoint<Dim> nearest(const Point<Dim>& x, double reach) const;
  // Its gap alone.
  double clearance(const Point<Dim>& x, double reach) const;

 private:
  enum class Side : char { outside, beside, crossed, inside };
  static Side side_of(const FacetCells<Dim>& cells, std::int32_t c);
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  Side side(std::int32_t leaf) const { return side_[index(leaf)]; }

  BackgroundTree<Dim> tree_;
  double room_ = 0;
  const BoundaryMesh<Dim>* boundary_ = nullptr;
  std::vector<FacetCorners<Dim>> corners_;  // asked far more often than anything else of facets
  FacetBlocks<Dim> blocks_;
  std::vector<Side> side_;  // of the leaves
  std::vector<ReferencePoint<Dim>> reference_;
  std::vector<char> cell_has_facets_;  // of all cells: can a facet be in it?
  std::vector<std::int32_t> offset_;   // facets of each leaf
  std::vector<std::int32_t> leaf_facets_;
};

extern template class FacetIndex<2>;
extern template class FacetIndex<3>;

}  // namespace pnpbs
