// SPDX-License-Identifier: BSD-3-Clause
#include "picture/triangle_values.hpp"

#include <array>
#include <cmath>

#include "picture/triangle_shape.hpp"

namespace pnpbs::picture {
namespace {

TriangleShape shape_of(const NodeSet& nodes, const std::array<std::size_t, 3>& corners) {
  TriangleShape triangle{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t a = corners[k], b = corners[(k + 1) % 3];
    triangle.edge[k] =
        std::hypot(nodes.xy[2 * b] - nodes.xy[2 * a], nodes.xy[2 * b + 1] - nodes.xy[2 * a + 1]);
    triangle.spacing[k] = nodes.spacing[a];
  }
  return triangle;
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
  return value_of(by_, shape_of(nodes_, corners(triangle)));
}

std::string TriangleValues::title() const {
  return title_of(by_, "quality 2 r_in / R", "triangles", scale_, count());
}

}  // namespace pnpbs::picture
