// SPDX-License-Identifier: BSD-3-Clause
// A patch of triangles on a sphere. A value is interpolated linearly in the flat triangle, at its
// intersection with the ray from the centre. All computations are in space, because triangles
// around the projection point are unbounded in a chart.
#pragma once

#include <cstdint>
#include <vector>

#include "spacing/nodal_patch.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

// A patch on a sphere with the interface of NodalPatch.
class SpherePatch {
 public:
  static constexpr int kDim = 2, kIn = 3;

  SpherePatch() = default;
  // The nodes of `patch` must lie on the sphere of this radius.
  SpherePatch(Patch<2, 3> patch, double radius);

  // x must lie on the sphere. The gap of an answer is the squared distance in space.
  void interpolate(const Point<3>& x, PatchAnswer<2>& best) const;
  void extend(const Point<3>& x, PatchAnswer<2>& best) const;

  const Patch<2, 3>& patch() const { return patch_; }
  PatchWeights<2> weights(const Point<3>& x, std::int32_t row) const;

  std::vector<Box<3>> simplices_cover(std::size_t many) const { return by_triangle_.cover(many); }
  std::vector<Box<3>> border_cover(std::size_t many) const { return by_side_.cover(many); }

 private:
  Patch<2, 3> patch_;
  double radius_ = 0;
  BoxTree<3> by_triangle_, by_side_;
};

}  // namespace pnpbs
