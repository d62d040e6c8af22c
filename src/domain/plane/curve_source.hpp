// SPDX-License-Identifier: BSD-3-Clause
// A curve or graph of a plane domain as the user gave it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

// Fills xy[n] for t[n]; throws Error on failure.
using CurveFunction = std::function<void(std::int64_t n, const double* t, Point<2>* xy)>;

enum class CurveRole {
  boundary,  // separates inside and outside
  inner      // nodes follow it, both sides are inside
};

struct CurveSource {
  enum class Kind {
    polyline,  // straight segments from point to point
    smooth,    // an arc or a general curve; `points` are samples of it
    graph      // a planar straight-line graph
  };

  Kind kind = Kind::polyline;
  std::int64_t number = 0;               // among the curves, or among the graphs
  CurveRole role = CurveRole::boundary;  // not of graphs
  bool closed = false;  // polylines: a segment leads from the last point to the first
  std::vector<Point<2>> points;
  std::vector<std::int32_t> tags;  // of the segments
  double corner_angle = 0;         // polylines: degrees
  // Polylines on a sphere: of points, is it none of those given, and only follows the shortest way
  // between two of these? Empty: none is.
  std::vector<char> on_the_way;

  std::vector<double> parameters;  // smooth: of the samples
  CurveFunction evaluate;          // smooth

  std::vector<std::int32_t> point_tags;                   // graphs: 0 takes the segment's
  std::vector<std::array<std::int64_t, 2>> segment_ends;  // graphs
  std::vector<char> corners;                              // graphs: of points; empty: all are
  std::int64_t first_number = 0;                          // graphs: what the user calls vertex 0

  // What points and segments were when they were given; empty: they still are.
  std::vector<std::int64_t> point_numbers, segment_numbers;

  std::int64_t segment_count() const;
  std::array<std::int64_t, 2> ends(std::int64_t segment) const;
  std::int32_t segment_tag(std::int64_t segment) const;
  std::int64_t point_number(std::int64_t point) const;
  std::int64_t segment_number(std::int64_t segment) const;

  // Does the curve end in this point (of an open polyline, or of a smooth curve)?
  bool ends_at(std::int64_t point) const;

  // For messages.
  std::string point_name(std::int64_t point) const;
  std::string segment_name(std::int64_t segment) const;
  std::string segments_name(std::int64_t first, std::int64_t last) const;  // a chain of them
};

}  // namespace pnpbs
