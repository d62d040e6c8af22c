// SPDX-License-Identifier: BSD-3-Clause
// Boundary and inner curves of a domain, from outlines of polygons and from lines. Edges that
// neighbouring polygons share are inner curves; the other edges bound the union of the polygons.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/message_text.hpp"
#include "base/types.hpp"
#include "geo/shape_file.hpp"

namespace pnpbs::geo {

// The distinct points of a layer, called vertices. They are referred to by their indices.
class Places {
 public:
  // Returns the index of the point, which is added if it is new.
  std::int64_t add(const Point<2>& point);
  const std::vector<Point<2>>& points() const { return points_; }

 private:
  struct Hash {
    std::size_t operator()(const Point<2>& point) const;
  };
  std::unordered_map<Point<2>, std::int64_t, Hash> numbers_;
  std::vector<Point<2>> points_;
};

// An outline, hole or line of the file as indices of vertices.
struct Route {
  PathKind kind;
  std::int64_t feature;
  std::int32_t tag;
  std::vector<std::int64_t> places;
};

// A chain of straight segments.
struct Curve {
  bool bounds;  // bounds the domain; otherwise lies inside it
  bool closed;
  std::vector<std::int64_t> places;  // vertices; a closed curve does not repeat the first one
  std::vector<std::int32_t> tags;    // tag of each segment
  // Comes from a line of the file, not from a polygon.
  bool of_line = false;
};

inline std::size_t segments_of(const Curve& curve) {
  return curve.closed ? curve.places.size() : curve.places.size() - 1;
}

inline std::int64_t end_of(const Curve& curve, std::size_t segment) {
  return curve.places[(segment + 1) % curve.places.size()];
}

// The curves of a layer, and counts of the edges that were merged or left out.
struct Outlines {
  std::vector<Curve> curves;
  std::int64_t shared_edges = 0;  // edges that two polygons share
  // Edges that a feature passes in both directions, or that lines repeat.
  std::int64_t dropped_edges = 0;
  std::int64_t retagged_edges = 0;  // outline edges that got the tag of a line on them
  std::int64_t lost_tags = 0;       // line edges on other lines with another tag
  std::int64_t outer_edges = 0;     // shared edges left out by leave_out_shared_edges_outside()

  // If the outlines enclose the point of projection of a sphere, the domain is outside the
  // polygons. Then removes the edges that polygons share, which are outside the domain.
  void leave_out_shared_edges_outside(const std::vector<Point<2>>& points);
};

// Describes a vertex in error messages.
using WordsFor = std::function<MessageText(std::int64_t place)>;
// Builds the curves of polygons, whose areas must not overlap, and of lines. Closed lines outside
// all polygons bound the domain, see classify_lines(). `radius`: radius of the sphere whose
// stereographic projection contains the points, or 0 in the plane. Throws Error with a vertex
// described by `where`.
Outlines outlines_of(std::vector<Route> routes, const std::vector<Point<2>>& points,
                     const WordsFor& where, double radius = 0);

}  // namespace pnpbs::geo
