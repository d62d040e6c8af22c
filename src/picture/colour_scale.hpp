// SPDX-License-Identifier: BSD-3-Clause
// What colour a number has, and the numbers to write at its bar.
#pragma once

#include <span>
#include <vector>

#include "picture/palette.hpp"

namespace pnpbs::picture {

constexpr int colour_classes = 49;  // odd, so that one of them is the middle's

struct ColourScale {
  double low = 0, high = 1;  // beyond them the colour is that of the end
  bool logarithmic = false;
  bool below = false, above = false;  // some values are beyond
  std::span<const Colour> palette = spacing_palette;

  bool uniform() const { return !(high > low); }
  double fraction(double value) const;  // 0 at low to 1 at high
  int class_of(double value) const;
  Colour colour(int index) const { return mixed(palette, (index + 0.5) / colour_classes); }

  // Both ends and round numbers between them, ascending.
  std::vector<double> ticks() const;
};

}  // namespace pnpbs::picture
