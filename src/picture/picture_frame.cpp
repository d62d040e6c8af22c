// SPDX-License-Identifier: BSD-3-Clause
#include "picture/picture_frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pnpbs::picture {
namespace {

constexpr double min_width = 700;  // width that the legend needs. [pixels]

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace

Box<2> bounds_of(std::initializer_list<std::span<const double>> points) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Box<2> box{{infinity, infinity}, {-infinity, -infinity}};
  for (const std::span<const double> part : points) {
    for (std::size_t i = 0; i < part.size(); ++i) {
      box.low[i % 2] = std::min(box.low[i % 2], part[i]);
      box.high[i % 2] = std::max(box.high[i % 2], part[i]);
    }
  }
  return box.low[0] <= box.high[0] ? box : Box<2>{};
}

PictureFrame frame_around(const Box<2>& bounds, const std::vector<double>& spacing,
                          const PictureSize& size, const std::string& unit) {
  const double wide = bounds.high[0] - bounds.low[0], high = bounds.high[1] - bounds.low[1];
  double longer = std::max(wide, high);
  if (!(longer > 0)) longer = 1;  // a single point, or none

  PictureFrame frame{};
  frame.typical_spacing = median(spacing);
  frame.unit = unit;
  const double requested = frame.typical_spacing > 0 ? longer / frame.typical_spacing : 0;
  const double side = std::clamp(requested * size.target_spacing, size.min_side, size.max_side);
  frame.pixels_per_unit = side / longer;
  frame.font_size = std::round(std::clamp(side / 60, 15.0, 34.0));
  frame.margin = 1.5 * frame.font_size;
  frame.line_width = side / 1000;
  frame.width = std::ceil(std::max(frame.pixels(wide) + 2 * frame.margin, min_width));
  frame.height = std::ceil(frame.pixels(high) + 2 * frame.margin + 3.5 * frame.font_size);
  frame.left = 0.5 * (frame.width - frame.pixels(wide));
  frame.top = frame.margin;
  frame.low_x = bounds.low[0];
  frame.high_y = bounds.high[1];
  return frame;
}

}  // namespace pnpbs::picture
