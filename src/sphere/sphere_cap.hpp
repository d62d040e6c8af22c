// SPDX-License-Identifier: BSD-3-Clause
// A cap of a sphere: all points within a distance of a centre. In the chart it is a disc or, if it
// contains the projection centre, the outside of a disc.
#pragma once

#include "sphere/stereographic_chart.hpp"

namespace pnpbs {

class SphereCap {
 public:
  // Constructs a cap from its centre and `length`, a straight distance through space. More than
  // nine tenths of the diameter of the sphere select the whole sphere.
  SphereCap(const StereographicChart& chart, const Point<2>& centre, double length);

  bool is_whole_sphere() const { return whole_; }
  bool holds(const Point<2>& u) const;
  // Returns whether the cap and the box intersect. Returns true if rounding leaves it undecided.
  bool meets(const Box<2>& box) const;
  // Returns whether the cap contains the inside of the circle in the chart through the centre of
  // the cap, a and b, which are counter-clockwise. Returns false if rounding leaves it undecided.
  bool holds_circle(const Point<2>& a, const Point<2>& b) const;

 private:
  StereographicChart chart_;
  Point<2> centre_;
  double length_, centre_stretch_;
  bool whole_;
};

}  // namespace pnpbs
