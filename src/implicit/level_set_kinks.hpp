// SPDX-License-Identifier: BSD-3-Clause
// Points where the gradient of a level set jumps along its surface: of its edges, where it has two
// values, and of its corners, where it has three or more. There the surface is the meet of the
// pieces on the sides, each of which is known by its tangent planes: nearer and nearer to the meet
// these are taken, until what they bend between does not matter.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "implicit/level_set.hpp"

namespace pnpbs {

// Angles in radians between normals. What turns less is no edge, but is looked at from half of it.
inline constexpr double kKinkAngle = 40 * 0.017453292519943295;

// Points found are within the square of this, over the radius to which the sides are bent, of both;
// in units of the resolution.
inline constexpr double kKinkReach = 1e-4;

bool turn_less(const Point<3>& normal, const Point<3>& other, double angle);

// Between two points near the surface, in the plane of the way between and of `up`.
struct CreaseSearch {
  std::array<Point<3>, 2> sides;
  Point<3> up;
};

struct CreasePoint {
  Point<3> position;
  std::array<Point<3>, 2> normals;  // unit, there, of either side
};

// Of each search what was found, or nothing where the surface is smooth or not understood.
std::vector<std::optional<CreasePoint>> find_crease_points(
    const LevelSet& set, const std::vector<CreaseSearch>& searches);

// A piece of the surface at a corner.
struct CornerSide {
  Point<3> normal;                // unit, somewhere on it
  std::vector<Point<3>> samples;  // on it
};

// The corner where three pieces or more meet, near x.
std::optional<Point<3>> find_corner(const LevelSet& set, const Point<3>& x,
                                    std::vector<CornerSide> sides);

}  // namespace pnpbs
