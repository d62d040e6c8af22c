// SPDX-License-Identifier: BSD-3-Clause
// How a sphere about the origin is looked at: from far away, or all of it at once as a map.
#pragma once

#include "base/types.hpp"

namespace pnpbs::picture {

struct SphereView {
  double radius = 1;
  bool as_map = false;  // plate carrée: longitude to the right, latitude upwards
  Point<2> from{};      // otherwise orthographic, seen from above this longitude and latitude
};

}  // namespace pnpbs::picture
