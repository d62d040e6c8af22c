// SPDX-License-Identifier: BSD-3-Clause
// The edges of triangles that are painted one by one.
#pragma once

#include <algorithm>

#include "picture/palette.hpp"

namespace pnpbs::picture {

// Darkest where triangles are large, so that small ones do not become a dark mist. longest: of the
// triangle's sides, in pixels.
inline Colour edge_colour(const Colour& face, double longest) {
  constexpr double strength = 0.72, full_edge = 14, no_edge = 2.5;
  const Colour both[2] = {face, ink};
  return mixed(both, strength * std::clamp((longest - no_edge) / (full_edge - no_edge), 0.0, 1.0));
}

}  // namespace pnpbs::picture
