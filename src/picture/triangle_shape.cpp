// SPDX-License-Identifier: BSD-3-Clause
#include "picture/triangle_shape.hpp"

#include <algorithm>

namespace pnpbs::picture {
namespace {

// 2 r_in / R = (b + c - a) (c + a - b) (a + b - c) / (a b c)
double quality(const TriangleShape& triangle) {
  const auto [a, b, c] = triangle.edge;
  if (!(a > 0 && b > 0 && c > 0)) return 0;
  return std::clamp((b + c - a) / a * ((c + a - b) / b) * ((a + b - c) / c), 0.0, 1.0);
}

double edge_over_spacing(const TriangleShape& triangle) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    sum += triangle.edge[k] / (0.5 * (triangle.spacing[k] + triangle.spacing[(k + 1) % 3]));
  return sum / 3;
}

double mean_spacing(const TriangleShape& triangle) {
  const auto [a, b, c] = triangle.spacing;
  return (a + b + c) / 3;
}

}  // namespace

double value_of(ElementColour by, const TriangleShape& triangle) {
  switch (by) {
    case ElementColour::quality:
      return quality(triangle);
    case ElementColour::edge:
      return edge_over_spacing(triangle);
    case ElementColour::spacing:
      return mean_spacing(triangle);
    case ElementColour::none:
      break;
  }
  return 0;
}

}  // namespace pnpbs::picture
