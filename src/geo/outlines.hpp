// SPDX-License-Identifier: BSD-3-Clause
// What bounds a domain, and what lies in it, of outlines of polygons and lines. Neighbouring
// polygons have edges in common; these are inner curves, and the others bound their union.
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

// Points at the same place are one.
class Places {
 public:
  std::int64_t add(const Point<2>& point);
  const std::vector<Point<2>>& points() const { return points_; }

 private:
  struct Hash {
    std::size_t operator()(const Point<2>& point) const;
  };
  std::unordered_map<Point<2>, std::int64_t, Hash> numbers_;
  std::vector<Point<2>> points_;
};

// A path by the numbers of its places.
struct Route {
  PathKind kind;
  std::int64_t feature;
  std::int32_t tag;
  std::vector<std::int64_t> places;
};

// Straight segments between places.
struct Curve {
  bool bounds;  // the domain; otherwise it lies in it
  bool closed;
  std::vector<std::int64_t> places;  // of closed ones, the first is not repeated
  std::vector<std::int32_t> tags;    // of the segments
  bool of_line = false;
};

inline std::size_t segments_of(const Curve& curve) {
  return curve.closed ? curve.places.size() : curve.places.size() - 1;
}

inline std::int64_t end_of(const Curve& curve, std::size_t segment) {
  return curve.places[(segment + 1) % curve.places.size()];
}

struct Outlines {
  std::vector<Curve> curves;
  std::int64_t shared_edges = 0;    // of neighbours
  std::int64_t dropped_edges = 0;   // there and back in one feature, or twice the same line
  std::int64_t retagged_edges = 0;  // of outlines, that a line has, too: its tag counts
  std::int64_t lost_tags = 0;       // of lines that have an edge in common with others
  std::int64_t outer_edges = 0;     // of neighbours, where the domain is what no polygon covers

  // On a sphere that is seen from a point in one of the polygons, edges that two of them share are
  // outside of the domain.
  void leave_out_shared_edges_outside(const std::vector<Point<2>>& points);
};

// Outlines enclose areas that do not overlap. Closed lines outside of all of them bound the domain,
// too. Throws Error with the place, for which `where` finds words.
using WordsFor = std::function<MessageText(std::int64_t place)>;
// radius: of the sphere that the points are in a stereographic projection of, or 0 for the plane.
Outlines outlines_of(std::vector<Route> routes, const std::vector<Point<2>>& points,
                     const WordsFor& where, double radius = 0);

}  // namespace pnpbs::geo
