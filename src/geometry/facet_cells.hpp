// SPDX-License-Identifier: BSD-3-Clause
// Which facets meet the cells of a background tree, and on which side of them the cells lie, while
// the tree grows.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/boundary_mesh.hpp"
#include "tree/background_tree.hpp"

namespace pnpbs {

// A point, and whether it is inside the domain: of others near it that follows from the facets on
// the way to them.
template <int Dim>
struct ReferencePoint {
  Point<Dim> x{};
  bool inside = false;
};

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

 private:
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  void inherit(std::int32_t parent, const Box<Dim>& box, std::vector<std::int32_t>& facets,
               std::vector<std::size_t>& offset) const;
  bool on_facet_of(std::int32_t c, const Point<Dim>& x) const;
  ReferencePoint<Dim> reference_in(const Box<Dim>& box, std::int32_t parent) const;

  const BoundaryMesh<Dim>& mesh_;
  std::vector<FacetCorners<Dim>> corners_;
  std::vector<ReferencePoint<Dim>> references_;  // of the cells
  std::vector<std::size_t> offset_{0};
  std::vector<std::int32_t> facets_;  // of cell after cell
  // The same with those that have nodes in a cell, where these may be off their facets.
  std::vector<std::size_t> beside_offset_{0};
  std::vector<std::int32_t> beside_;
};

extern template class FacetCells<2>;
extern template class FacetCells<3>;

}  // namespace pnpbs
