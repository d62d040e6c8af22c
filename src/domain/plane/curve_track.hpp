// SPDX-License-Identifier: BSD-3-Clause
// A boundary curve parametrised by arc length. A station is the arc length from the begin of the
// curve, measured along its polyline.
#pragma once

#include <vector>

#include "domain/plane/plane_domain.hpp"
#include "geometry/polyline_track.hpp"

namespace pnpbs {

class CurveTrack : public PolylineTrack<2> {
 public:
  // Stores a reference to the curve, which must outlive this object.
  explicit CurveTrack(const BoundaryCurve& curve);

  const BoundaryCurve& curve() const { return *curve_; }

  // Returns points of the true curve at ascending stations.
  std::vector<Point<2>> points_at(const std::vector<double>& stations) const;

  // Returns true if the curve is a straight segment between the two stations.
  bool is_straight(double begin, double end) const;

  // Returns an upper estimate of the distance between the curve and its chord.
  double deviation(double begin, double end) const;

 private:
  const BoundaryCurve* curve_;
};

}  // namespace pnpbs
