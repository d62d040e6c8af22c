// SPDX-License-Identifier: BSD-3-Clause
#include "picture/body_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pnpbs::picture {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double turned = 26 * degree;  // to the right
constexpr double raised = 22 * degree;
constexpr Point<3> lamp{-0.46, 0.56, 0.69};  // right, up, toward us
constexpr double flat_lying = 0.8;           // z of a plane that is rather a floor than a wall

}  // namespace

Point<3> unit_vector(const Point<3>& v) {
  const double length = std::sqrt(dot(v, v));
  return length > 0 ? Point<3>{v[0] / length, v[1] / length, v[2] / length} : Point<3>{};
}

BodyView::BodyView(const CutPlane& plane) {
  const Point<3> normal = unit_vector(plane.normal);
  const bool floor = std::fabs(normal[2]) > flat_lying;
  // z is up on a wall. On a floor y is, and we stand before it.
  const Point<3> right = unit_vector(cross(floor ? Point<3>{0, 1, 0} : Point<3>{0, 0, 1}, normal));
  const Point<3> up = cross(normal, right);
  const double rise = floor ? -raised : raised;
  for (std::size_t k = 0; k < 3; ++k)
    toward_[k] = std::cos(rise) * (std::cos(turned) * normal[k] + std::sin(turned) * right[k]) +
                 std::sin(rise) * up[k];
  right_ = unit_vector(cross(up, toward_));
  up_ = cross(toward_, right_);
  on_plane_ = light(normal);
}

double BodyView::light(const Point<3>& normal) const {
  const Point<3> seen{dot(normal, right_), dot(normal, up_), dot(normal, toward_)};
  return 0.5 + 0.5 * dot(seen, lamp);
}

}  // namespace pnpbs::picture
