// SPDX-License-Identifier: BSD-3-Clause
// Colour scales: the mapping from values to colours, and the ticks of the colour bar.
#pragma once

#include <span>
#include <vector>

#include "picture/palette.hpp"

namespace pnpbs::picture {

constexpr int colour_classes = 49;  // odd, so that one class is centred on the middle of the scale

// A linear or logarithmic scale that maps values to the colours of a palette.
struct ColourScale {
  double low = 0, high = 1;  // values outside have the colour of the nearer end
  bool logarithmic = false;
  bool below = false, above = false;  // some values lie below low, above high
  std::span<const Colour> palette = spacing_palette;

  bool uniform() const { return !(high > low); }
  double fraction(double value) const;  // 0 at low, 1 at high
  int class_of(double value) const;
  Colour colour(int index) const { return mixed(palette, (index + 0.5) / colour_classes); }

  // Returns both ends and the round numbers between them, ascending.
  std::vector<double> ticks() const;
};

}  // namespace pnpbs::picture
