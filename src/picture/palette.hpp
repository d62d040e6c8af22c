// SPDX-License-Identifier: BSD-3-Clause
// Colours and palettes of pictures.
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
constexpr Colour ink = colour(0x1f2a37);  // text and boundary lines
constexpr Colour boundary_node = colour(0xb5482f);
constexpr Colour open_boundary = colour(0x1f8fd6);
constexpr Colour triangle_edge = colour(0xbcc6d0);

// Returns the colour at a fraction, 0 to 1, of the palette `stops` by linear interpolation.
inline Colour mixed(std::span<const Colour> stops, double fraction) {
  const double place = std::clamp(fraction, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const double part = place - static_cast<double>(below);
  const auto mix = [part](double a, double b) { return a + part * (b - a); };
  return {mix(stops[below].red, stops[below + 1].red),
          mix(stops[below].green, stops[below + 1].green),
          mix(stops[below].blue, stops[below + 1].blue)};
}

// Colours from small to large spacing: dark to light, also readable in grey and with colour
// blindness.
inline constexpr std::array spacing_palette{colour(0x1b2f5b), colour(0x245f8f), colour(0x2f8f9d),
                                            colour(0x77b38a), colour(0xd9b95b)};
// Colours from bad to good triangles: dark to light, so that bad ones stand out.
inline constexpr std::array quality_palette{colour(0x3b0f70), colour(0x8c2981), colour(0xde4968),
                                            colour(0xfe9f6d), colour(0xfcfdbf)};
// Colours from short to long edges: pale where the length is d.
inline constexpr std::array edge_palette{colour(0x2166ac), colour(0x67a9cf), colour(0xf4f2ee),
                                         colour(0xef8a62), colour(0xb2182b)};

inline Colour spacing_colour(double fraction) { return mixed(spacing_palette, fraction); }

// Returns the colour of a triangle's edge. It is darkest for large triangles, since dark edges
// would hide small ones. longest: longest side of the triangle. [pixels]
inline Colour edge_colour(const Colour& face, double longest) {
  constexpr double strength = 0.72, full_edge = 14, no_edge = 2.5;
  const Colour both[2] = {face, ink};
  return mixed(both, strength * std::clamp((longest - no_edge) / (full_edge - no_edge), 0.0, 1.0));
}

}  // namespace pnpbs::picture
