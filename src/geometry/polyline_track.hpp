// SPDX-License-Identifier: BSD-3-Clause
// A polyline parametrized by arc length. A station is the arc length from its beginning.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

template <int Dim>
class PolylineTrack {
 public:
  static constexpr int kDim = Dim;

  // Stores a reference to `points`, which must outlive this object.
  PolylineTrack(const std::vector<Point<Dim>>& points, bool closed)
      : points_(&points), closed_(closed) {
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      vertex_stations_.push_back(vertex_stations_.back() + distance<Dim>(points[i], points[i + 1]));
  }

  bool is_closed() const { return closed_; }
  double length() const { return vertex_stations_.back(); }
  const std::vector<double>& vertex_stations() const { return vertex_stations_; }

  // Returns the last segment that begins at or before the station.
  std::size_t segment_at(double station) const {
    const auto after =
        std::upper_bound(vertex_stations_.begin() + 1, vertex_stations_.end() - 1, station);
    return static_cast<std::size_t>(after - vertex_stations_.begin()) - 1;
  }

  // Calls visit(i, segment, fraction) for each station in ascending order. Station i lies at
  // `fraction` of the segment.
  template <class Visit>
  void for_places(const std::vector<double>& stations, const Visit& visit) const {
    std::size_t segment = stations.empty() ? 0 : segment_at(stations.front());
    for (std::size_t i = 0; i < stations.size(); ++i) {
      while (segment + 2 < vertex_stations_.size() && vertex_stations_[segment + 1] <= stations[i])
        ++segment;
      const double begin = vertex_stations_[segment], end = vertex_stations_[segment + 1];
      visit(i, segment, (stations[i] - begin) / (end - begin));
    }
  }

  Point<Dim> point(std::size_t segment, double fraction) const {
    const Point<Dim>&a = (*points_)[segment], &b = (*points_)[segment + 1];
    Point<Dim> x;
    for (std::size_t k = 0; k < Dim; ++k) x[k] = a[k] + fraction * (b[k] - a[k]);
    return x;
  }

  std::vector<Point<Dim>> points_at(const std::vector<double>& stations) const {
    std::vector<Point<Dim>> points(stations.size());
    for_places(stations, [&](std::size_t i, std::size_t segment, double fraction) {
      points[i] = point(segment, fraction);
    });
    return points;
  }

 private:
  const std::vector<Point<Dim>>* points_;
  bool closed_;
  std::vector<double> vertex_stations_{0};
};

}  // namespace pnpbs
