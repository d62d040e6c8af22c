// SPDX-License-Identifier: BSD-3-Clause
// A curve or a planar straight-line graph of a plane domain as the user gave it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

// Evaluates the curve at n parameters t. Throws Error on failure.
using CurveFunction = std::function<void(std::int64_t n, const double* t, Point<2>* xy)>;

// How a curve relates to the domain.
enum class CurveRole {
  boundary,  // separates inside and outside
  inner      // nodes lie on it, and both sides are inside
};

// One curve or one graph of the user.
struct CurveSource {
  enum class Kind {
    polyline,  // straight segments between consecutive points
    smooth,    // an arc or a general curve; `points` are samples of it
    graph      // a planar straight-line graph
  };

  Kind kind = Kind::polyline;
  // Number among the curves, or among the graphs; negative for sides of a periodic cell
  std::int64_t number = 0;
  CurveRole role = CurveRole::boundary;  // not used for graphs
  bool closed = false;                   // polylines: a segment joins the last point to the first
  std::vector<Point<2>> points;
  std::vector<std::int32_t> tags;  // one per segment
  double corner_angle = 0;         // polylines [degrees]
  // Polylines on a sphere: nonzero for points that were inserted on a great circle between two
  // given points. Empty if none exist.
  std::vector<char> on_the_way;

  std::vector<double> parameters;  // smooth curves: parameters of the samples
  CurveFunction evaluate;          // smooth curves only

  std::vector<std::int32_t> point_tags;                   // graphs: 0 means the tag of the segment
  std::vector<std::array<std::int64_t, 2>> segment_ends;  // graphs: indices into `points`
  std::vector<char> corners;      // graphs: per point; if empty, all are corners
  std::int64_t first_number = 0;  // graphs: the user's number of vertex 0
  // Graphs: nonzero for points that were moved onto a vertex (snapping.hpp). Empty if none were.
  std::vector<char> snapped;

  // Original numbers of points and segments as the user gave them. If empty, indices are the
  // original numbers.
  std::vector<std::int64_t> point_numbers, segment_numbers;

  std::int64_t segment_count() const;
  std::array<std::int64_t, 2> ends(std::int64_t segment) const;
  std::int32_t segment_tag(std::int64_t segment) const;
  std::int64_t point_number(std::int64_t point) const;
  std::int64_t segment_number(std::int64_t segment) const;

  // Returns true if the point is an end of an open polyline or of a smooth curve.
  bool ends_at(std::int64_t point) const;

  // Names for messages. segments_name() names a chain of segments.
  std::string point_name(std::int64_t point) const;
  std::string segment_name(std::int64_t segment) const;
  std::string segments_name(std::int64_t first, std::int64_t last) const;

  // Returns the beginning of all names of this source: "curve 3, ", or "" for the first graph.
  std::string name_prefix() const;
  // Returns the number of a segment in messages.
  std::int64_t shown_segment_number(std::int64_t segment) const;
};

// Returns the name of a chain of segments with these first and last numbers. The numbers between
// them need not be consecutive if `reordered` is true.
std::string chain_name(const std::string& prefix, std::int64_t from, std::int64_t until,
                       bool reordered);

}  // namespace pnpbs
