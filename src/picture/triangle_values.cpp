// SPDX-License-Identifier: BSD-3-Clause
#include "picture/triangle_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace pnpbs::picture {
namespace {

struct Triangle {
  std::array<double, 3> edge;     // edge k is from corner k to the next
  std::array<double, 3> spacing;  // at the corners
};

Triangle triangle_of(const NodeSet& nodes, const std::array<std::size_t, 3>& corners) {
  Triangle triangle{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t a = corners[k], b = corners[(k + 1) % 3];
    triangle.edge[k] =
        std::hypot(nodes.xy[2 * b] - nodes.xy[2 * a], nodes.xy[2 * b + 1] - nodes.xy[2 * a + 1]);
    triangle.spacing[k] = nodes.spacing[a];
  }
  return triangle;
}

// 2 r_in / R = (b + c - a) (c + a - b) (a + b - c) / (a b c)
double quality(const Triangle& triangle) {
  const auto [a, b, c] = triangle.edge;
  if (!(a > 0 && b > 0 && c > 0)) return 0;
  return std::clamp((b + c - a) / a * ((c + a - b) / b) * ((a + b - c) / c), 0.0, 1.0);
}

double edge_over_spacing(const Triangle& triangle) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    sum += triangle.edge[k] / (0.5 * (triangle.spacing[k] + triangle.spacing[(k + 1) % 3]));
  return sum / 3;
}

double mean_spacing(const Triangle& triangle) {
  const auto [a, b, c] = triangle.spacing;
  return (a + b + c) / 3;
}

}  // namespace

TriangleValues::TriangleValues(const NodeSet& nodes, ElementColour by) : nodes_(nodes), by_(by) {
  scale_ = scale_for(by, {count(), [this](std::size_t triangle) { return at(triangle); }});
}

std::array<std::size_t, 3> TriangleValues::corners(std::size_t triangle) const {
  const std::array<std::int64_t, 3>& ends = nodes_.triangles[triangle];
  return {static_cast<std::size_t>(ends[0]), static_cast<std::size_t>(ends[1]),
          static_cast<std::size_t>(ends[2])};
}

double TriangleValues::at(std::size_t triangle) const {
  const Triangle shape = triangle_of(nodes_, corners(triangle));
  switch (by_) {
    case ElementColour::quality:
      return quality(shape);
    case ElementColour::edge:
      return edge_over_spacing(shape);
    case ElementColour::spacing:
      return mean_spacing(shape);
    case ElementColour::none:
      break;
  }
  return 0;
}

std::string TriangleValues::title() const {
  return title_of(by_, "quality 2 r_in / R", "triangles", scale_, count());
}

}  // namespace pnpbs::picture
