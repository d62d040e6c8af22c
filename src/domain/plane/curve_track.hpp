// SPDX-License-Identifier: BSD-3-Clause
// A boundary curve by its arc length. A station is the length of the way from the curve's begin.
#pragma once

#include <vector>

#include "domain/plane/plane_domain.hpp"
#include "geometry/polyline_track.hpp"

namespace pnpbs {

class CurveTrack : public PolylineTrack<2> {
 public:
  // Keeps a reference to the curve.
  explicit CurveTrack(const BoundaryCurve& curve);

  const BoundaryCurve& curve() const { return *curve_; }

  // The points of the (true) curve at rising stations.
  std::vector<Point<2>> points_at(const std::vector<double>& stations) const;

  // Is the curve a straight segment between two stations?
  bool is_straight(double begin, double end) const;

  // How far it goes from the straight line between them, at most.
  double deviation(double begin, double end) const;

 private:
  const BoundaryCurve* curve_;
};

}  // namespace pnpbs
