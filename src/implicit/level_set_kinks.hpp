// SPDX-License-Identifier: BSD-3-Clause
// Finds points of a level set's surface at which the gradient jumps: on its edges, where it has two
// values, and at its corners, where it has three or more. Each side is approximated by a tangent
// plane, and the planes meet at the point. The tangent planes are evaluated ever nearer to the
// point, until the curvature of the sides is negligible.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "implicit/level_set.hpp"

namespace pnpbs {

// Least angle between the normals of two sides at an edge. [radians] Searches begin at half of it.
inline constexpr double kKinkAngle = 40 * 0.017453292519943295;

// Final distance of the tangent planes from the point found. [resolution] The error is the square
// of it over the radius of curvature of the sides.
inline constexpr double kKinkReach = 1e-4;

// Returns true if the angle between two unit normals is less than `angle`.
bool turn_less(const Point<3>& normal, const Point<3>& other, double angle);

// A search between two points near the surface, in the plane of their difference and `up`.
struct CreaseSearch {
  std::array<Point<3>, 2> sides;
  Point<3> up;
};

// A point on an edge of the surface.
struct CreasePoint {
  Point<3> position;
  std::array<Point<3>, 2> normals;  // unit normals of both sides there
};

// Returns the point found by each search, or nothing where the surface is smooth or the search
// fails.
std::vector<std::optional<CreasePoint>> find_crease_points(
    const LevelSet& set, const std::vector<CreaseSearch>& searches);

// A side of the surface at a corner.
struct CornerSide {
  Point<3> normal;                // unit normal at some point of the side
  std::vector<Point<3>> samples;  // points of the side
};

// Returns the corner near x at which three sides or more meet, or nothing.
std::optional<Point<3>> find_corner(const LevelSet& set, const Point<3>& x,
                                    std::vector<CornerSide> sides);

}  // namespace pnpbs
