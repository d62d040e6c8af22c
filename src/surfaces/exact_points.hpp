// SPDX-License-Identifier: BSD-3-Clause
// Points of surfaces, given or constructed as intersections of edges and triangles, with exact
// positions. Decisions about constructed points are exact. They use rounded positions first and
// integers of any length where these cannot decide.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/types.hpp"
#include "predicates/wide_integer.hpp"

namespace pnpbs {

// Projects a point along axis k. The remaining coordinates are in cyclic order.
inline Point<2> projection(int k, const Point<3>& x) { return {x[(k + 1) % 3], x[(k + 2) % 3]}; }

// Given points, and points constructed from them. A point has one index, however often it is
// constructed.
class ExactPoints {
 public:
  // Two of the given points may not coincide, except points that are never used.
  explicit ExactPoints(std::span<const Point<3>> given);

  // Makes a given point known, so that a point constructed at its position gets its index. A given
  // point must be known before others are constructed from it.
  void use(std::int32_t p);

  std::int32_t given_count() const { return given_count_; }
  std::int32_t count() const { return static_cast<std::int32_t>(positions_.size()); }
  // Returns the position; that of a constructed point is the double nearest in each coordinate.
  const Point<3>& position(std::int32_t p) const { return positions_[static_cast<std::size_t>(p)]; }

  // Returns the point where the line through a and b meets the plane of the triangle. These must be
  // given points, and the line must not be parallel to the plane.
  std::int32_t on_plane(std::int32_t a, std::int32_t b, const std::array<std::int32_t, 3>& plane);
  // Returns the point where the line through a and b meets the line through c and d. The lines must
  // lie in one plane, and must not be parallel in the projection along axis k.
  std::int32_t on_lines(int k, std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d);

  // Returns the orientation of three points in the projection along axis k: > 0 if they are
  // counter-clockwise, 0 if they are on a line.
  int orientation(int k, std::int32_t a, std::int32_t b, std::int32_t c) const;
  // Returns whether a precedes b in the lexicographic order of the projection along axis k.
  bool precedes(int k, std::int32_t a, std::int32_t b) const;

 private:
  // The position is x / w in units of 2^lowest_bit_, and w > 0.
  struct Homogeneous {
    std::array<WideInteger, 3> x;
    WideInteger w;
  };
  struct PositionHash {
    std::size_t operator()(const Point<3>& x) const;
  };

  const Homogeneous& exact(std::int32_t p) const {
    return exact_[static_cast<std::size_t>(exact_index_[static_cast<std::size_t>(p)])];
  }
  bool is_given(std::int32_t p) const { return p < given_count_; }
  bool on_one_edge(std::int32_t a, std::int32_t b, std::int32_t c) const;
  int compare(int axis, std::int32_t a, std::int32_t b) const;
  WideInteger determinant(int k, std::int32_t a, std::int32_t b, std::int32_t c) const;
  Homogeneous combination(const WideInteger& at_a, std::int32_t a, const WideInteger& at_b,
                          std::int32_t b) const;
  // Returns the index of the point, which is added if it is new.
  std::int32_t index_of(Homogeneous point, std::array<std::int32_t, 2> edge);

  std::int32_t given_count_;
  int lowest_bit_;
  std::vector<Point<3>> positions_;
  std::vector<std::int32_t> exact_index_;           // per point: its index in exact_, or -1
  std::deque<Homogeneous> exact_;                   // of the known points
  std::vector<std::array<std::int32_t, 2>> edges_;  // per constructed point: two given points
  std::vector<std::int32_t> next_;                  // the next point with the same rounded position
  std::unordered_map<Point<3>, std::int32_t, PositionHash> first_;  // known points by position
};

}  // namespace pnpbs
