// SPDX-License-Identifier: BSD-3-Clause
// A cap of a sphere in a chart of it: what lies within a length of a point of the chart. There it
// is a disc or, with the point that is projected from in it, all that lies around one.
#pragma once

#include "sphere/stereographic_chart.hpp"

namespace pnpbs {

class SphereCap {
 public:
  // The length is one straight through space. One of more than nine tenths of the sphere's diameter
  // means the whole sphere.
  SphereCap(const StereographicChart& chart, const Point<2>& centre, double length);

  bool is_whole_sphere() const { return whole_; }
  bool holds(const Point<2>& u) const;
  // Has it a point in common with the box? True where rounding leaves that open.
  bool meets(const Box<2>& box) const;
  // Is all that lies inside of the circle in the chart through its centre, a and b, which follow
  // each other counter-clockwise, in it? False where rounding leaves that open.
  bool holds_circle(const Point<2>& a, const Point<2>& b) const;

 private:
  StereographicChart chart_;
  Point<2> centre_;
  double length_, centre_stretch_;
  bool whole_;
};

}  // namespace pnpbs
