// SPDX-License-Identifier: BSD-3-Clause
// A part of a triangulation with a value at each node, interpolated linearly on each simplex. One
// rank stores one patch of a spacing that is given at nodes. Several patches may answer for one
// point; the smallest answer in a total order counts, so the result does not depend on the
// distribution.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "tree/box_tree.hpp"

namespace pnpbs {

// A node of a patch with its value.
template <int Dim>
struct PatchNode {
  Point<Dim> x;
  std::int64_t id;
  double value;
};

// A set of simplices with nodes and border. `In` is the number of coordinates, which exceeds Dim on
// a surface.
template <int Dim, int In = Dim>
struct Patch {
  std::vector<PatchNode<In>> nodes;
  // Node indices, sorted by id in each row.
  std::vector<std::array<std::int32_t, Dim + 1>> simplices;
  std::vector<std::array<std::int32_t, Dim>> border;  // facets of one simplex only
  // For each border facet, the remaining corner of its simplex, or -1 if that is not known. May be
  // empty.
  std::vector<std::int32_t> behind;
  // In a periodic domain: the last nodes are images, of these nodes (patch_images.hpp).
  std::vector<std::int32_t> images;

  // Returns the node of which a node is an image, or the node itself.
  std::int32_t node_of(std::int32_t n) const {
    const auto image = static_cast<std::size_t>(n) + images.size();
    return image < nodes.size() ? n : images[image - nodes.size()];
  }
};

// The nodes and weights from which the value at a point is interpolated or extrapolated.
template <int Dim>
struct PatchWeights {
  std::array<std::int32_t, Dim + 1> nodes{};  // indices in the patch
  std::array<double, Dim + 1> weights{};      // the sum is 1
  bool inside = false;                        // true: no weight is negative
};

template <int Dim>
// A value at a point with its origin. The order of answers prefers the smallest gap, then the
// smallest ids.
struct PatchAnswer {
  // Squared distance of the point to the simplex or facet.
  double gap = std::numeric_limits<double>::infinity();
  std::array<std::int64_t, Dim + 1> ids{};  // ids of the nodes that the value comes from
  double value = 0;
  // The rank that gave the answer, and the index of the simplex there. A border facet f has the row
  // -1 - f.
  std::int32_t rank = -1, row = 0;

  bool found() const { return gap < std::numeric_limits<double>::infinity(); }
  bool operator<(const PatchAnswer& other) const {
    return gap != other.gap ? gap < other.gap : ids < other.ids;
  }
};

template <int Dim>
// A patch with search trees over its simplices and border facets.
class NodalPatch {
 public:
  static constexpr int kDim = Dim, kIn = Dim;

  NodalPatch() = default;
  explicit NodalPatch(Patch<Dim> patch);

  // Interpolates at x in the simplex that contains x, and stores the answer in `best` if it is
  // smaller. If several simplices contain x, the one with the smallest ids counts. Leaves `best`
  // unchanged if none does.
  void interpolate(const Point<Dim>& x, PatchAnswer<Dim>& best) const;
  // Takes the value at the nearest point of the border if this point is nearer than `best`.
  void extend(const Point<Dim>& x, PatchAnswer<Dim>& best) const;

  const Patch<Dim>& patch() const { return patch_; }
  // Returns the weights of the nodes for an answer of this patch at x. The interpolant is that of
  // the simplex `row`. For a border facet it is extrapolated from the simplex behind it, or, if
  // this is not known, taken at the point of the facet nearest to x.
  PatchWeights<Dim> weights(const Point<Dim>& x, std::int32_t row) const;

  // Returns at most `many` boxes that cover the simplices; border_cover() does so for the border
  // facets.
  std::vector<Box<Dim>> simplices_cover(std::size_t many) const { return by_simplex_.cover(many); }
  std::vector<Box<Dim>> border_cover(std::size_t many) const { return by_facet_.cover(many); }

 private:
  Patch<Dim> patch_;
  BoxTree<Dim> by_simplex_, by_facet_;
};

extern template class NodalPatch<2>;
extern template class NodalPatch<3>;

}  // namespace pnpbs
