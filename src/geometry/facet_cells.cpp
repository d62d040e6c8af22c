// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/facet_cells.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/plane/edges.hpp"
#include "geometry/volume/triangles.hpp"
#include "tree/cell_samples.hpp"

namespace pnpbs {

namespace {

// In units of the cell's side; and the steps to others, should a facet hold the first.
constexpr double kFirstReference[3] = {0.41421356, 0.57721566, 0.69314718};
constexpr double kReferenceSteps[3] = {0.6180339887, 0.7548776662, 0.8191725134};

}  // namespace

template <int Dim>
FacetCells<Dim>::FacetCells(const BoundaryMesh<Dim>& mesh) : mesh_(mesh) {
  corners_.reserve(mesh.facets.size());
  for (const auto& facet : mesh.facets) corners_.push_back(corners_of(mesh, facet));
}

template <int Dim>
void FacetCells<Dim>::add_root(const BackgroundTree<Dim>& tree) {
  references_.push_back({tree.origin(), false});  // strictly outside the domain's bounding box
  facets_.resize(corners_.size());
  std::iota(facets_.begin(), facets_.end(), 0);
  offset_.push_back(facets_.size());
  if (mesh_.node_distance > 0) {
    beside_ = facets_;
    beside_offset_ = offset_;
  }
}

// The facets of the parent that may meet the box.
template <int Dim>
void FacetCells<Dim>::inherit(std::int32_t parent, const Box<Dim>& box,
                              std::vector<std::int32_t>& facets,
                              std::vector<std::size_t>& offset) const {
  for (std::size_t k = offset[index(parent)]; k < offset[index(parent) + 1]; ++k)
    if (may_meet_box(corners_[index(facets[k])], box)) facets.push_back(facets[k]);
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
  for (const std::int32_t f : facets(c))
    if (on_facet(corners_[index(f)], x)) return true;
  return false;
}

template <int Dim>
bool FacetCells<Dim>::inside(std::int32_t c, const Point<Dim>& x) const {
  const ReferencePoint<Dim>& from = reference(c);
  bool inside = from.inside;
  for (const std::int32_t f : facets(c))
    if (mesh_.facets[index(f)].bounds() && crosses(from.x, x, corners_[index(f)])) inside = !inside;
  return inside;
}

template class FacetCells<2>;
template class FacetCells<3>;

}  // namespace pnpbs
