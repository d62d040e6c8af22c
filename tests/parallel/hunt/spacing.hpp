// SPDX-License-Identifier: BSD-3-Clause
//
// Random spacings: constant, growing from a point, a line or a plane, layers with jumps, and waves.
#pragma once

#include <pnpbs/pnpbs.h>

#include <string>

#include "body.hpp"

namespace hunt {

struct Spacing {
  enum class Kind { constant, grows, layers, waves } kind = Kind::constant;
  Frame frame;      // frame of the body, in which the following values are given
  double base = 1;  // the smallest value
  double slope = 0;
  Point from{};
  int directions = 3;  // dimensions of the distance: 3 to a point, 2 to a line, 1 to a plane
  double width = 1;    // of a layer or a wave
  double factor = 1;   // from layer to layer

  double at(const Point& world) const;
  std::string name() const;
};

Spacing random_spacing(Random& random, const Body& body);

/** Sets the spacing of a placement. `spacing` must not move as long as the placement uses it. */
pnpbs_status set(pnpbs_placement placement, const Spacing& spacing);

}  // namespace hunt
