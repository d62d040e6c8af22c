// SPDX-License-Identifier: BSD-3-Clause
// The facets of the boundary sorted into the leaves of a background tree, and the side of the
// boundary on which each leaf lies. It determines whether a point is inside and which facets are
// near it.
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

// Bounding boxes of blocks of consecutive facets. If the boundary is much finer than d, thousands
// of facets are near a node and few of them intersect the segment to another node. The boxes allow
// whole blocks of the others to be skipped.
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

  // Returns the number of facets from row[k] on that form a block which cannot meet segment xy. It
  // is 0 if there is no such block, which is the usual case.
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

  // Calls visit(facet) for the facets of an ascending row, except for blocks for whose box
  // is_off(box) returns true.
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
        continue;  // The row lacks some facets of the block.
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

  // Extends a box by the rounding error of the computation of its middle.
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

// A point, and whether it is inside the domain. For other points near it, this follows from the
// facets that the segment between the two crosses.
template <int Dim>
struct ReferencePoint {
  Point<Dim> x{};
  bool inside = false;
};

// The facets that meet each cell of a growing background tree, and the side of the boundary on
// which each cell lies.
template <int Dim>
class FacetCells {
 public:
  explicit FacetCells(const BoundaryMesh<Dim>& mesh);

  // Cells must be added in their order, the root first. A child inherits those facets of its parent
  // that meet it.
  void add_root(const BackgroundTree<Dim>& tree);
  void add_children(const BackgroundTree<Dim>& tree, std::int32_t parent);

  std::int32_t count() const { return static_cast<std::int32_t>(references_.size()); }
  std::span<const std::int32_t> facets(std::int32_t c) const {
    return {facets_.data() + offset_[index(c)], facets_.data() + offset_[index(c) + 1]};
  }
  bool crossed(std::int32_t c) const { return offset_[index(c)] < offset_[index(c) + 1]; }
  bool outside(std::int32_t c) const { return !crossed(c) && !reference(c).inside; }
  // Returns whether nodes of facets that do not meet the cell can lie in it.
  bool has_facets_beside(std::int32_t c) const {
    return mesh_.node_distance > 0 && beside_offset_[index(c)] < beside_offset_[index(c) + 1];
  }
  // Returns a point of the cell that is not on a facet.
  const ReferencePoint<Dim>& reference(std::int32_t c) const { return references_[index(c)]; }

  // Returns whether x, in cell c, is inside the domain. Either result is possible if x is on a
  // facet.
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
  std::vector<ReferencePoint<Dim>> references_;  // One per cell.
  std::vector<std::size_t> offset_{0};
  std::vector<std::int32_t> facets_;  // Facets of all cells, ordered by cell.
  // As offset_ and facets_, but for each cell the facets whose nodes can lie in it. If nodes can be
  // off their facets, these are more than the facets that meet the cell.
  std::vector<std::size_t> beside_offset_{0};
  std::vector<std::int32_t> beside_;
};

extern template class FacetCells<2>;
extern template class FacetCells<3>;

template <int Dim>
struct NearestPoint {
  double gap;               // Distance to the point.
  std::int32_t facet = -1;  // Facet that contains the point; -1 if none is within reach.
  Point<Dim> x{};
};

template <int Dim>
class FacetIndex {
 public:
  FacetIndex() = default;
  // Builds the index of all leaves of the tree. The mesh must outlive this object.
  FacetIndex(BackgroundTree<Dim> tree, const FacetCells<Dim>& cells);

  const BackgroundTree<Dim>& tree() const { return tree_; }
  // Returns a generous bound of the rounding errors of positions.
  double room() const { return room_; }
  const BoundaryMesh<Dim>& boundary() const { return *boundary_; }

  bool leaf_outside(std::int32_t leaf) const {
    return side(leaf) == Side::outside || side(leaf) == Side::beside;
  }
  // Returns whether no node can be in the leaf. Nodes of level sets can be in leaves outside the
  // domain, beside a facet.
  bool leaf_empty(std::int32_t leaf) const { return side(leaf) == Side::outside; }
  bool leaf_has_facets(std::int32_t leaf) const {
    return offset_[index(leaf)] < offset_[index(leaf) + 1];
  }
  // Returns the facets that meet the leaf in ascending order.
  std::span<const std::int32_t> facets_of_leaf(std::int32_t leaf) const {
    const std::int32_t* const all = leaf_facets_.data();
    return {all + offset_[index(leaf)], all + offset_[index(leaf) + 1]};
  }

  // Returns whether x is strictly inside the domain, so not on a facet.
  bool inside(const Point<Dim>& x) const { return inside_in_leaf(tree_.leaf_at(x), x); }
  bool inside_in_leaf(std::int32_t leaf, const Point<Dim>& x) const;
  // Returns whether x lies exactly on a facet that has the domain on both sides, and on none that
  // bounds it.
  bool on_inner_facet(const Point<Dim>& x) const;

  // Calls visit(facet index) for every facet that can be within `reach` of x. A facet can be
  // visited more than once.
  template <class Visit>
  void for_facets_near(const Point<Dim>& x, double reach, const Visit& visit) const {
    const auto has_facets = [this](std::int32_t cell) {
      return cell_has_facets_[index(cell)] != 0;
    };
    tree_.for_leaves_in(box_around<Dim>(x, reach), has_facets, [&](std::int32_t leaf) {
      for (const std::int32_t f : facets_of_leaf(leaf)) visit(f);
    });
  }

  // Returns whether segment ab crosses a facet of the leaf. A segment that ends on a facet does not
  // cross it.
  bool facet_between(std::int32_t leaf, const Point<Dim>& a, const Point<Dim>& b) const;

  const FacetCorners<Dim>& corners(std::int32_t f) const { return corners_[index(f)]; }
  const BoundaryFacet<Dim>& facet(std::int32_t f) const { return boundary_->facets[index(f)]; }
  const FacetBlocks<Dim>& facet_blocks() const { return blocks_; }

  // Returns the nearest point of the facets if it is closer to x than `reach`. Otherwise the gap is
  // `reach` and the facet -1. Of facets at the same distance, the one with the smallest index is
  // returned.
  NearestPoint<Dim> nearest(const Point<Dim>& x, double reach) const;
  // Returns the gap of nearest().
  double clearance(const Point<Dim>& x, double reach) const;

 private:
  enum class Side : char { outside, beside, crossed, inside };
  static Side side_of(const FacetCells<Dim>& cells, std::int32_t c);
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  Side side(std::int32_t leaf) const { return side_[index(leaf)]; }

  BackgroundTree<Dim> tree_;
  double room_ = 0;
  const BoundaryMesh<Dim>* boundary_ = nullptr;
  // A copy, because corners are read far more often than other facet data.
  std::vector<FacetCorners<Dim>> corners_;
  FacetBlocks<Dim> blocks_;
  std::vector<Side> side_;  // One per leaf.
  std::vector<ReferencePoint<Dim>> reference_;
  std::vector<char> cell_has_facets_;  // One per cell of the tree: whether it can contain a facet.
  std::vector<std::int32_t> offset_;   // Offsets of the leaves in leaf_facets_.
  std::vector<std::int32_t> leaf_facets_;
};

extern template class FacetIndex<2>;
extern template class FacetIndex<3>;

// Builds an index with a background tree of its own, whose cells contain few facets each whatever d
// is. The mesh must outlive the index.
template <int Dim>
FacetIndex<Dim> index_facets(const BoundaryMesh<Dim>& mesh, const Box<Dim>& bounds);

extern template FacetIndex<2> index_facets(const BoundaryMesh<2>&, const Box<2>&);
extern template FacetIndex<3> index_facets(const BoundaryMesh<3>&, const Box<3>&);

}  // namespace pnpbs
