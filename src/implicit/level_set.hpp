// SPDX-License-Identifier: BSD-3-Clause
// A body given by a function f: the points where f < 0.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

// Evaluates f at n points x. Throws Error on failure.
using LevelSetFunction = std::function<void(std::int64_t n, const Point<3>* x, double* values)>;

// Value and finite differences of f at a point.
struct LevelSetSlope {
  Point<3> x;  // the point, moved into the box if it is outside
  double f;
  Point<3> gradient;
  double kink;  // largest difference of one-sided slopes over |gradient|; small if f is smooth

  Point<3> normal() const;  // unit; 0 if the gradient is 0
};

// A function f on a box, and the length scale at which it is resolved.
class LevelSet {
 public:
  // `name` is used in messages. f is evaluated only inside the box. Features thinner than
  // `resolution` may be lost.
  LevelSet(std::string name, LevelSetFunction f, const Box<3>& box, double resolution);

  const std::string& name() const { return name_; }
  const Box<3>& box() const { return box_; }
  double resolution() const { return resolution_; }

  // Returns f at the points. Throws Error(ErrorKind::domain) if a value is not finite.
  std::vector<double> values(std::span<const Point<3>> x) const;

  // Returns central differences of f. `step` is in units of the resolution; the error is of second
  // order in it. Differences across a kink are meaningless.
  std::vector<LevelSetSlope> slopes(std::span<const Point<3>> x, double step = kSlopeStep) const;
  // Default step. [resolution] If the resolution is a hundredth of the size, rounding and curvature
  // each cost about a third of the digits of f.
  static constexpr double kSlopeStep = 1e-4;

  // Estimates the distance of each point from the zero of f along a unit direction, in either
  // sense, from the slope of f in that direction. Needs less than half of the evaluations of
  // slopes().
  std::vector<double> distances_along(std::span<const Point<3>> x,
                                      std::span<const Point<3>> directions) const;

  // Moves points along the gradient of f to f = 0. A point that does not reach f = 0 within `reach`
  // stays. Each result depends on its own point only. Returns for each point whether f = 0 there
  // now.
  std::vector<char> project(std::span<Point<3>> x, double reach) const;

 private:
  Point<3> in_box(Point<3> x) const;

  std::string name_;
  LevelSetFunction f_;
  Box<3> box_;
  double resolution_;
};

// A segment with f < 0 at exactly one end.
struct CrossedSegment {
  Point<3> begin, end;
  double f_begin, f_end;
};

// Returns for each segment a point at which f is 0 or changes its sign.
std::vector<Point<3>> zeros_on(const LevelSet& set, const std::vector<CrossedSegment>& segments);

}  // namespace pnpbs
