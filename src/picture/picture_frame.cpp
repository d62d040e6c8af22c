// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "picture/picture.hpp"

namespace pnpbs::picture {
namespace {

constexpr double wanted_spacing = 14;  // pixels between typical nodes, if there is room
constexpr double min_side = 1000;      // pixels of the domain's longer side
constexpr double max_side = 2400;
constexpr double min_width = 700;  // room for the legend

struct Bounds {
  double low[2] = {std::numeric_limits<double>::infinity(),
                   std::numeric_limits<double>::infinity()};
  double high[2] = {-low[0], -low[1]};

  void take(const std::vector<double>& xy) {
    for (std::size_t i = 0; i < xy.size(); ++i) {
      low[i % 2] = std::min(low[i % 2], xy[i]);
      high[i % 2] = std::max(high[i % 2], xy[i]);
    }
  }
  double size(int k) const { return high[k] > low[k] ? high[k] - low[k] : 0; }
};

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace

PictureFrame frame_for(const NodeSet& nodes) {
  Bounds bounds;
  bounds.take(nodes.outline);
  bounds.take(nodes.xy);
  double longer = std::max(bounds.size(0), bounds.size(1));
  if (!(longer > 0)) longer = 1;  // a single point, or nothing at all
  if (nodes.size() == 0 && nodes.outline.empty()) bounds = {{0, 0}, {0, 0}};

  PictureFrame frame{};
  frame.typical_spacing = median(nodes.spacing);
  const double wished = frame.typical_spacing > 0 ? longer / frame.typical_spacing : 0;
  const double side = std::clamp(wished * wanted_spacing, min_side, max_side);
  frame.pixels_per_unit = side / longer;
  frame.font_size = std::round(std::clamp(side / 60, 15.0, 34.0));
  frame.margin = 1.5 * frame.font_size;
  frame.line_width = side / 1000;
  frame.width = std::ceil(std::max(frame.pixels(bounds.size(0)) + 2 * frame.margin, min_width));
  frame.height = std::ceil(frame.pixels(bounds.size(1)) + 2 * frame.margin + 3.5 * frame.font_size);
  frame.left = 0.5 * (frame.width - frame.pixels(bounds.size(0)));
  frame.top = frame.margin;
  frame.low_x = bounds.low[0];
  frame.high_y = bounds.high[1];
  return frame;
}

}  // namespace pnpbs::picture
