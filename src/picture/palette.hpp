// SPDX-License-Identifier: BSD-3-Clause
// The colours of the pictures.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

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

// From small spacing (0) to large (1): dark to light, also for the colour-blind and in grey.
inline Colour spacing_colour(double fraction) {
  constexpr std::array stops{colour(0x1b2f5b), colour(0x245f8f), colour(0x2f8f9d), colour(0x77b38a),
                             colour(0xd9b95b)};
  const double place = std::clamp(fraction, 0.0, 1.0) * (stops.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const double part = place - static_cast<double>(below);
  const auto mix = [part](double a, double b) { return a + part * (b - a); };
  return {mix(stops[below].red, stops[below + 1].red),
          mix(stops[below].green, stops[below + 1].green),
          mix(stops[below].blue, stops[below + 1].blue)};
}

}  // namespace pnpbs::picture
