// SPDX-License-Identifier: BSD-3-Clause
// The facets of the boundary by the leaves of a background tree, and on which side of them the
// leaves lie. Answers "is x inside?" and "which facets are near x?".
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/boundary_mesh.hpp"
#include "geometry/plane/edges.hpp"
#include "geometry/volume/triangles.hpp"
#include "tree/background_tree.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

// Boxes around blocks of consecutive facets. Where a boundary is far finer than d a node has
// thousands of facets near it, and few of them lie on the way to another node: the others are
// passed over block by block.
template <int Dim>
class FacetBlocks {
 public:
  void build(std::span<const FacetCorners<Dim>> facets) {
    for (std::size_t l = 0; l < kSizes.size(); ++l) {
      boxes_[l].clear();
      for (std::size_t first = 0; first + kSizes[l] <= facets.size(); first += kSizes[l])
        boxes_[l].push_back(with_room(box_around(facets.subspan(first, kSizes[l]))));
    }
  }

  // Of a row of facets from place k on: how many make up a block that surely does not meet the way
  // from x to y? Usually none.
  std::size_t facets_off_segment(std::span<const std::int32_t> row, std::size_t k,
                                 const Point<Dim>& x, const Point<Dim>& y) const {
    for (std::size_t l = 0; l < kSizes.size(); ++l) {
      const auto first = static_cast<std::size_t>(row[k]);
      if (first % kSizes[l] != 0 || k + kSizes[l] > row.size()) continue;
      if (!is_block(row.subspan(k, kSizes[l]))) continue;
      if (!segment_may_meet_box(x, y, boxes_[l][first / kSizes[l]])) return kSizes[l];
    }
    return 0;
  }

  // Calls visit(facet) for the facets of an ascending row, except for those in blocks for whose
  // boxes is_off(box) is true.
  template <class IsOff, class Visit>
  void for_facets(std::span<const std::int32_t> row, const IsOff& is_off,
                  const Visit& visit) const {
    for (std::size_t k = 0; k < row.size();) {
      const std::size_t off = facets_off(row, k, is_off);
      k += off;
      if (off == 0) visit(row[k++]);
    }
  }

 private:
  static constexpr std::array<std::size_t, 2> kSizes{256, 16};

  template <class IsOff>
  std::size_t facets_off(std::span<const std::int32_t> row, std::size_t k,
                         const IsOff& is_off) const {
    const auto first = static_cast<std::size_t>(row[k]);
    for (std::size_t l = 0; l < kSizes.size(); ++l) {
      const std::size_t last = k + kSizes[l] - 1;
      if (first % kSizes[l] != 0 || last >= row.size()) continue;
      if (static_cast<std::size_t>(row[last]) - first != kSizes[l] - 1)
        continue;  // some are missing
      if (is_off(boxes_[l][first / kSizes[l]])) return kSizes[l];
    }
    return 0;
  }

  static bool is_block(std::span<const std::int32_t> facets) {
    bool consecutive = true;
    for (std::size_t f = 0; f < facets.size(); ++f)
      consecutive = consecutive & (facets[f] == facets[0] + static_cast<std::int32_t>(f));
    return consecutive;
  }

  static Box<Dim> box_around(std::span<const FacetCorners<Dim>> facets) {
    Box<Dim> box{facets[0][0], facets[0][0]};
    for (const FacetCorners<Dim>& corners : facets)
      for (const Point<Dim>& x : corners) box = joined(box, {x, x});
    return box;
  }

  // For the rounding of its middle.
  static Box<Dim> with_room(Box<Dim> box) {
    constexpr double kRounding = 8 * 0x1p-52;
    for (std::size_t k = 0; k < Dim; ++k) {
      const double room = kRounding * (std::fabs(box.low[k]) + std::fabs(box.high[k]));
      box.low[k] -= room;
      box.high[k] += room;
    }
    return box;
  }

  std::array<std::vector<Box<Dim>>, kSizes.size()> boxes_;
};

// A point, and whether it is inside the domain: of others near it that follows from the facets on
// the way to them.
template <int Dim>
struct ReferencePoint {
  Point<Dim> x{};
  bool inside = false;
};

// Which facets meet the cells of a background tree, and on which side of them the cells lie, while
// the tree grows.
template <int Dim>
class FacetCells {
 public:
  explicit FacetCells(const BoundaryMesh<Dim>& mesh);

  // Cells are added in their order, the root first. A child inherits the facets of its parent that
  // meet it.
  void add_root(const BackgroundTree<Dim>& tree);
  void add_children(const BackgroundTree<Dim>& tree, std::int32_t parent);

  std::int32_t count() const { return static_cast<std::int32_t>(references_.size()); }
  std::span<const std::int32_t> facets(std::int32_t c) const {
    return {facets_.data() + offset_[index(c)], facets_.data() + offset_[index(c) + 1]};
  }
  bool crossed(std::int32_t c) const { return offset_[index(c)] < offset_[index(c) + 1]; }
  bool outside(std::int32_t c) const { return !crossed(c) && !reference(c).inside; }
  // May nodes of facets be in it that do not meet it?
  bool has_facets_beside(std::int32_t c) const {
    return mesh_.node_distance > 0 && beside_offset_[index(c)] < beside_offset_[index(c) + 1];
  }
  // Never on a facet.
  const ReferencePoint<Dim>& reference(std::int32_t c) const { return references_[index(c)]; }

  // Is x, in cell c, inside the domain? (On a facet: it may be.)
  bool inside(std::int32_t c, const Point<Dim>& x) const;

  const BoundaryMesh<Dim>& mesh() const { return mesh_; }
  const std::vector<FacetCorners<Dim>>& corners() const { return corners_; }
  const FacetBlocks<Dim>& blocks() const { return blocks_; }

 private:
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  void inherit(std::int32_t parent, const Box<Dim>& box, std::vector<std::int32_t>& facets,
               std::vector<std::size_t>& offset) const;
  bool on_facet_of(std::int32_t c, const Point<Dim>& x) const;
  ReferencePoint<Dim> reference_in(const Box<Dim>& box, std::int32_t parent) const;

  const BoundaryMesh<Dim>& mesh_;
  std::vector<FacetCorners<Dim>> corners_;
  FacetBlocks<Dim> blocks_;
  std::vector<ReferencePoint<Dim>> references_;  // of the cells
  std::vector<std::size_t> offset_{0};
  std::vector<std::int32_t> facets_;  // of cell after cell
  // The same with those that have nodes in a cell, where these may be off their facets.
  std::vector<std::size_t> beside_offset_{0};
  std::vector<std::int32_t> beside_;
};

extern template class FacetCells<2>;
extern template class FacetCells<3>;

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

// Builds an index with a background tree for the facets alone: its cells hold few of them each,
// whatever d is. The mesh must outlive the index.
template <int Dim>
FacetIndex<Dim> index_facets(const BoundaryMesh<Dim>& mesh, const Box<Dim>& bounds);

extern template FacetIndex<2> index_facets(const BoundaryMesh<2>&, const Box<2>&);
extern template FacetIndex<3> index_facets(const BoundaryMesh<3>&, const Box<3>&);

}  // namespace pnpbs
