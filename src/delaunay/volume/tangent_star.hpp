// SPDX-License-Identifier: BSD-3-Clause
// The star of a node within its surface. The neighbours that it sees are mapped to its tangent
// plane, where the plane's star is found. Inversion x -> x / |x|^2 about the node, in space, and
// then the projection on the tangent plane, give the points whose convex hull that star is: on a
// sphere this is the stereographic projection, which keeps circles, so that there, and in a plane,
// the stars of all nodes agree; elsewhere nearly all do.
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

// What a node sees on one side of it (see SurfaceSide).
struct StarSide {
  Point<3> normal;
  // The neighbours on the curves where the side begins and ends, counter-clockwise as seen from
  // where the normal points to; -1 and -1: it reaches all around.
  std::int32_t first, last;
  std::vector<SurfaceStarPoint> around;  // these two among them
};

// Of a neighbour j: is (node, j, next neighbour) a triangle?
struct SurfaceStarEntry {
  std::int32_t node;
  bool triangle;
};

// Are two nodes next to each other on a feature curve?
using Joined = std::function<bool(std::int32_t, std::int32_t)>;

// Appends the star, side after side, each counter-clockwise; where a side begins as another one
// ends it follows, so that around a manifold's node the order is cyclic. Returns whether it is
// complete: no node farther away than `reach`, up to which the sides hold all that is seen, could
// change it. If not, nothing is appended.
bool tangent_star(const SurfaceStarPoint& centre, double reach, std::span<const StarSide> sides,
                  const Joined& joined, std::vector<SurfaceStarEntry>& star);

// The tangent plane of a node, its axes a function of the normal alone.
class TangentPlane {
 public:
  TangentPlane(const Point<3>& normal, const Point<3>& centre);

  Point<2> centre() const { return centre_; }
  // Where the star's point x comes to lie; the centre if it is straight above it.
  Point<2> image(const Point<3>& x) const;

 private:
  Point<2> projection(const Point<3>& x) const;

  Point<3> u_, v_, origin_;
  Point<2> centre_;
};

}  // namespace pnpbs
