// SPDX-License-Identifier: BSD-3-Clause
// The colours of the pictures.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace pnpbs::picture {

struct Colour {
  double red, green, blue;
};

constexpr Colour colour(unsigned hexadecimal) {
  return {((hexadecimal >> 16) & 255) / 255.0, ((hexadecimal >> 8) & 255) / 255.0,
          (hexadecimal & 255) / 255.0};
}

constexpr Colour paper = colour(0xffffff);
constexpr Colour ink = colour(0x1f2a37);  // text, boundary lines
constexpr Colour boundary_node = colour(0xb5482f);
constexpr Colour triangle_edge = colour(0xbcc6d0);

// The colour at a fraction of the way along the stops.
inline Colour mixed(std::span<const Colour> stops, double fraction) {
  const double place = std::clamp(fraction, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const double part = place - static_cast<double>(below);
  const auto mix = [part](double a, double b) { return a + part * (b - a); };
  return {mix(stops[below].red, stops[below + 1].red),
          mix(stops[below].green, stops[below + 1].green),
          mix(stops[below].blue, stops[below + 1].blue)};
}

// From small spacing to large: dark to light, also for the colour-blind and in grey.
inline constexpr std::array spacing_palette{colour(0x1b2f5b), colour(0x245f8f), colour(0x2f8f9d),
                                            colour(0x77b38a), colour(0xd9b95b)};
// From bad triangles to good ones: dark to light, so that the bad ones stand out.
inline constexpr std::array quality_palette{colour(0x3b0f70), colour(0x8c2981), colour(0xde4968),
                                            colour(0xfe9f6d), colour(0xfcfdbf)};
// From too short to too long, pale where it is right.
inline constexpr std::array edge_palette{colour(0x2166ac), colour(0x67a9cf), colour(0xf4f2ee),
                                         colour(0xef8a62), colour(0xb2182b)};

inline Colour spacing_colour(double fraction) { return mixed(spacing_palette, fraction); }

// Darkest where triangles are large, so that small ones do not become a dark mist. longest: of the
// triangle's sides, in pixels.
inline Colour edge_colour(const Colour& face, double longest) {
  constexpr double strength = 0.72, full_edge = 14, no_edge = 2.5;
  const Colour both[2] = {face, ink};
  return mixed(both, strength * std::clamp((longest - no_edge) / (full_edge - no_edge), 0.0, 1.0));
}

}  // namespace pnpbs::picture
