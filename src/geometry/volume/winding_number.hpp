// SPDX-License-Identifier: BSD-3-Clause
// How often triangles wind around a point: 1 inside of a closed surface and 0 outside; where the
// surface has holes something between, and where bodies overlap their sum. (Jacobson, Kavan and
// Sorkine-Hornung 2013.)
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/boundary_mesh.hpp"

namespace pnpbs {

// The solid angle of a triangle as x sees it, over that of a sphere: positive if x is on the side
// that its normal points away from. (Van Oosterom and Strackee 1983.)
double winding_of(const FacetCorners<3>& triangle, const Point<3>& x);

// Of many triangles, by a tree: of what is far two terms of a series count (Barill and others
// 2018), so that it is within some 0.01 of the sum over all triangles. Never mutates: any thread
// may ask.
class WindingNumber {
 public:
  WindingNumber() = default;
  explicit WindingNumber(std::vector<FacetCorners<3>> triangles);

  double operator()(const Point<3>& x) const { return cells_.empty() ? 0 : of_cell(0, x); }

 private:
  struct Cell {
    Point<3> middle{};                  // of the areas
    Point<3> area{};                    // sum of area times normal, the dipole
    std::array<Point<3>, 3> moments{};  // of the areas' places about the middle
    double radius = 0;                  // of the ball around the middle that holds all
    std::int32_t begin, end;            // of triangles_
    std::int32_t child = -1;            // the first of two, or none
  };

  void describe(Cell& cell) const;
  void split(std::size_t cell);
  double of_cell(std::int32_t cell, const Point<3>& x) const;

  std::vector<FacetCorners<3>> triangles_;  // by cells
  std::vector<Cell> cells_;
};

}  // namespace pnpbs
