// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/curve_track.hpp"

#include <algorithm>

#include "domain/plane/sampling.hpp"
#include "domain/plane/segments.hpp"

namespace pnpbs {

CurveTrack::CurveTrack(const BoundaryCurve& curve) : curve_(&curve), vertex_stations_{0} {
  for (std::size_t i = 0; i + 1 < curve.points.size(); ++i) {
    vertex_stations_.push_back(vertex_stations_.back() +
                               distance<2>(curve.points[i], curve.points[i + 1]));
  }
}

// The last segment that begins at or before the station.
std::size_t CurveTrack::segment_at(double station) const {
  const auto after =
      std::upper_bound(vertex_stations_.begin() + 1, vertex_stations_.end() - 1, station);
  return static_cast<std::size_t>(after - vertex_stations_.begin()) - 1;
}

std::vector<Point<2>> CurveTrack::points_at(const std::vector<double>& stations) const {
  std::vector<Point<2>> points(stations.size());
  std::vector<double> parameters;
  std::size_t segment = stations.empty() ? 0 : segment_at(stations.front());
  for (std::size_t i = 0; i < stations.size(); ++i) {
    while (segment + 2 < vertex_stations_.size() && vertex_stations_[segment + 1] <= stations[i]) {
      ++segment;
    }
    const double begin = vertex_stations_[segment], end = vertex_stations_[segment + 1];
    const double fraction = (stations[i] - begin) / (end - begin);
    if (curve_->evaluate) {
      const double t = curve_->parameters[segment];
      parameters.push_back(t + fraction * (curve_->parameters[segment + 1] - t));
    } else {
      const Point<2>&a = curve_->points[segment], &b = curve_->points[segment + 1];
      points[i] = {a[0] + fraction * (b[0] - a[0]), a[1] + fraction * (b[1] - a[1])};
    }
  }
  if (!parameters.empty()) {
    points = curve_points(curve_->evaluate, parameters, curve_->name);
  }
  return points;
}

bool CurveTrack::is_straight(double begin, double end) const {
  if (curve_->evaluate) return false;
  return vertex_stations_[segment_at(begin) + 1] >= end;
}

double CurveTrack::deviation(double begin, double end) const {
  const std::vector<Point<2>> ends = points_at({begin, end});
  double max = 0;
  for (std::size_t i = segment_at(begin) + 1; vertex_stations_[i] < end; ++i) {
    max = std::max(max, distance_to_segment(ends[0], ends[1], curve_->points[i]));
  }
  if (curve_->evaluate) {
    const Point<2> middle = points_at({0.5 * (begin + end)})[0];
    max = 1.5 * std::max(max, distance_to_segment(ends[0], ends[1], middle));
  }
  return max;
}

}  // namespace pnpbs
