// SPDX-License-Identifier: BSD-3-Clause
// The star of a node within its surface. The visible neighbours are mapped to its tangent plane,
// where the star of the plane is found. Inversion x -> x / |x|^2 about the node in space, followed
// by a projection onto the tangent plane, gives the points whose convex hull is that star. On a
// sphere this is the stereographic projection, which preserves circles. Therefore the stars of all
// nodes agree on spheres and planes. On other surfaces nearly all do.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "delaunay/plane/hull_star.hpp"

namespace pnpbs {

struct SurfaceStarPoint {
  Point<3> position;
  std::int64_t id;
  std::int32_t node;
};

// The nodes visible from a node on one side of it (see SurfaceSide).
struct StarSide {
  Point<3> normal;
  // Neighbours on the curves where the side begins and ends, counter-clockwise seen from the tip of
  // the normal. Both are -1 if the side extends all around.
  std::int32_t first, last;
  std::vector<SurfaceStarPoint> around;  // Includes these two.
};

// A neighbour, and whether the node, this and the next neighbour are a triangle.
struct SurfaceStarEntry {
  std::int32_t node;
  bool triangle;
};

// Returns whether two nodes are adjacent on a feature curve.
using Joined = std::function<bool(std::int32_t, std::int32_t)>;

// Appends the star, side by side, each counter-clockwise. A side follows the one that ends where it
// begins, so that the order is cyclic around a node of a manifold. Returns whether the star is
// complete, i.e. no node beyond `reach` can change it. The sides must contain all visible nodes
// within `reach`. If the result is false, nothing is appended.
bool tangent_star(const SurfaceStarPoint& centre, double reach, std::span<const StarSide> sides,
                  const Joined& joined, std::vector<SurfaceStarEntry>& star);

// The tangent plane of a node. Its axes are a function of the normal alone.
class TangentPlane {
 public:
  TangentPlane(const Point<3>& normal, const Point<3>& centre);

  Point<2> centre() const { return centre_; }
  // Returns the image of point x of the star. It is the centre if x is directly above it.
  Point<2> image(const Point<3>& x) const;

 private:
  Point<2> projection(const Point<3>& x) const;

  Point<3> u_, v_, origin_;
  Point<2> centre_;
};

}  // namespace pnpbs
