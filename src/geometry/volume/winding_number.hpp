// SPDX-License-Identifier: BSD-3-Clause
// The winding number of triangles around a point. It is 1 inside a closed surface and 0 outside,
// between the two if the surface has holes, and a sum where bodies overlap (Jacobson, Kavan and
// Sorkine-Hornung 2013).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/boundary_mesh.hpp"

namespace pnpbs {

// Returns the solid angle of a triangle seen from x over that of a sphere. It is positive if x is
// on the side opposite to the normal (Van Oosterom and Strackee 1983).
double winding_of(const FacetCorners<3>& triangle, const Point<3>& x);

// The winding number of many triangles. A tree replaces far triangles by two terms of a multipole
// series (Barill and others 2018), so that the result is within about 0.01 of the sum over all
// triangles. The call operator can be called by several threads at the same time.
class WindingNumber {
 public:
  WindingNumber() = default;
  explicit WindingNumber(std::vector<FacetCorners<3>> triangles);

  double operator()(const Point<3>& x) const { return cells_.empty() ? 0 : of_cell(0, x); }

 private:
  struct Cell {
    Point<3> middle{};                  // Area-weighted mean of the centroids.
    Point<3> area{};                    // Sum of the area normals, the dipole.
    std::array<Point<3>, 3> moments{};  // Moments of the area normals about the middle.
    double radius = 0;        // Radius of a ball around the middle that contains all triangles.
    std::int32_t begin, end;  // Range in triangles_.
    std::int32_t child = -1;  // Index of the first of two children, or -1.
  };

  void describe(Cell& cell) const;
  void split(std::size_t cell);
  double of_cell(std::int32_t cell, const Point<3>& x) const;

  std::vector<FacetCorners<3>> triangles_;  // Ordered by cells.
  std::vector<Cell> cells_;
};

}  // namespace pnpbs
