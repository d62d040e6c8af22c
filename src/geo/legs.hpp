// SPDX-License-Identifier: BSD-3-Clause
// The way between two places in degrees, in the plane of longitude and latitude. What goes on
// beyond 180 degrees, or over a pole, is not the straight line from one to the other there.
#pragma once

#include <array>
#include <cstddef>

#include "base/types.hpp"

namespace pnpbs::geo {

struct Leg {
  Point<2> from, to;
  bool operator==(const Leg&) const = default;
};

// Straight legs: one from end to end, or two with the same way in them. Of those on both sides of
// 180 degrees each has the whole way, of which half is where no longitudes are.
class Legs {
 public:
  static Legs straight(const Point<2>& a, const Point<2>& b) { return Legs({{{a, b}, {}}}, 1); }
  // Around the Earth, of places as Projection::canonical has them: a pole is on every meridian.
  static Legs shortest(const Point<2>& a, const Point<2>& b);

  const Leg* begin() const { return legs_.data(); }
  const Leg* end() const { return legs_.data() + count_; }
  bool operator==(const Legs&) const = default;
  // Of the way, or the pole that it leads over.
  Point<2> middle() const;

 private:
  Legs(const std::array<Leg, 2>& legs, std::size_t count) : legs_(legs), count_(count) {}

  std::array<Leg, 2> legs_;
  std::size_t count_;
};

// How far a place is off the great circle through two others, over how far it is from the nearer of
// these.
double off_great_circle(const Point<2>& place, const Point<2>& a, const Point<2>& b);

}  // namespace pnpbs::geo
