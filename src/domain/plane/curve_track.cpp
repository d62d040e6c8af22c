// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/curve_track.hpp"

#include <algorithm>

#include "domain/plane/sampling.hpp"
#include "geometry/plane/segments.hpp"

namespace pnpbs {

CurveTrack::CurveTrack(const BoundaryCurve& curve)
    : PolylineTrack(curve.points, curve.corner_begin == curve.corner_end), curve_(&curve) {}

std::vector<Point<2>> CurveTrack::points_at(const std::vector<double>& stations) const {
  if (!curve_->evaluate || stations.empty()) return PolylineTrack::points_at(stations);
  std::vector<double> parameters;
  for_places(stations, [&](std::size_t, std::size_t segment, double fraction) {
    const double t = curve_->parameters[segment];
    parameters.push_back(t + fraction * (curve_->parameters[segment + 1] - t));
  });
  return curve_points(curve_->evaluate, parameters, curve_->name);
}

bool CurveTrack::is_straight(double begin, double end) const {
  if (curve_->evaluate) return false;
  return vertex_stations()[segment_at(begin) + 1] >= end;
}

double CurveTrack::deviation(double begin, double end) const {
  const std::vector<Point<2>> ends = points_at({begin, end});
  double max = 0;
  for (std::size_t i = segment_at(begin) + 1; vertex_stations()[i] < end; ++i) {
    max = std::max(max, distance_to_segment(ends[0], ends[1], curve_->points[i]));
  }
  if (curve_->evaluate) {
    const Point<2> middle = points_at({0.5 * (begin + end)})[0];
    max = 1.5 * std::max(max, distance_to_segment(ends[0], ends[1], middle));
  }
  return max;
}

}  // namespace pnpbs
