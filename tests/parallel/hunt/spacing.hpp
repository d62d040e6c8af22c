// SPDX-License-Identifier: BSD-3-Clause
//
// Random spacings: constant, growing from a point, a line or a plane, layers that jump, waves.
#pragma once

#include <pnpbs/pnpbs.h>

#include <string>

#include "body.hpp"

namespace hunt {

struct Spacing {
  enum class Kind { constant, grows, layers, waves } kind = Kind::constant;
  Frame frame;      // the body's: what follows is in its coordinates
  double base = 1;  // where it is finest
  double slope = 0;
  Point from{};
  int directions = 3;  // that count for the distance: 3 to a point, 2 to a line, 1 to a plane
  double width = 1;    // of a layer or a wave
  double factor = 1;   // from layer to layer

  double at(const Point& world) const;
  std::string name() const;
};

Spacing random_spacing(Random& random, const Body& body);

/** Gives it to a placement; it must stay where it is as long as the placement uses it. */
pnpbs_status set(pnpbs_placement placement, const Spacing& spacing);

}  // namespace hunt
