// SPDX-License-Identifier: BSD-3-Clause
// A body that is given by a function: it is where f < 0.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

// Fills values[n] with f at x[n]; throws Error on failure.
using LevelSetFunction = std::function<void(std::int64_t n, const Point<3>* x, double* values)>;

// What f is like at a point.
struct LevelSetSlope {
  Point<3> x;  // the point, or the nearest one of the box
  double f;
  Point<3> gradient;
  double kink;  // differences of the slopes to either side, over the slope: small where f is smooth

  Point<3> normal() const;  // unit; 0 where there is no slope
};

class LevelSet {
 public:
  // `name` is for messages. f is asked in the box only. Features of the body that are thinner than
  // `resolution` may be lost.
  LevelSet(std::string name, LevelSetFunction f, const Box<3>& box, double resolution);

  const std::string& name() const { return name_; }
  const Box<3>& box() const { return box_; }
  double resolution() const { return resolution_; }

  // f at these points. Throws Error(ErrorKind::domain) where it is not finite.
  std::vector<double> values(std::span<const Point<3>> x) const;

  // By differences to either side. Their error is of second order in `step`, which is in units of
  // the resolution; at a kink they are of no use.
  std::vector<LevelSetSlope> slopes(std::span<const Point<3>> x, double step = kSlopeStep) const;
  // A third of the digits of f are lost to rounding, and as many to the bend of f, at a resolution
  // of a hundredth of the size.
  static constexpr double kSlopeStep = 1e-4;

  // Estimates the distance of each point from where f = 0, along a unit direction or against it, by
  // the slope of f in that direction. It takes less than half of the values that slopes() takes.
  std::vector<double> ways_along(std::span<const Point<3>> x,
                                 std::span<const Point<3>> directions) const;

  // Moves points to where f = 0, along the gradient of f that is found by differences. One that
  // does not come there within `reach` stays. What becomes of a point depends on it alone. Returns
  // for each point whether f = 0 there now.
  std::vector<char> project(std::span<Point<3>> x, double reach) const;

 private:
  Point<3> in_box(Point<3> x) const;

  std::string name_;
  LevelSetFunction f_;
  Box<3> box_;
  double resolution_;
};

// f is negative at one end alone.
struct CrossedSegment {
  Point<3> begin, end;
  double f_begin, f_end;
};

// A point of each where f = 0, or where it changes its sign.
std::vector<Point<3>> zeros_on(const LevelSet& set, const std::vector<CrossedSegment>& segments);

}  // namespace pnpbs
