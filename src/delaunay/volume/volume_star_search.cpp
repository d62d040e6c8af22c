// SPDX-License-Identifier: BSD-3-Clause
// Where nodes that are no candidates yet could change a star: in the spheres of tetrahedra that are
// not proven, and behind open faces.
#include <cmath>
#include <limits>

#include "delaunay/volume/volume_star.hpp"
#include "delaunay/volume/word_of_bits.hpp"
#include "predicates/space.hpp"

namespace pnpbs {

namespace {

constexpr double kBeyond = 1 + 1e-9;  // distances are rounded

}  // namespace

// A place in the plane of the centre and two neighbours, between these and not as far out as they
// are after inversion, is nothing that a sphere of an element can reach which holds neither.
bool VolumeStar::is_shielded(const Point<3>& y) const {
  constexpr double kThin = 1e-3, kSlack = 1e-9, kMargin = 1e-6;
  if (unit_ < 0.01 * max_reach()) return false;
  return std::any_of(shields_.begin(), shields_.end(), [&](const Face& face) {
    const Point<3>& normal = face.normal;
    const double square = dot(normal, normal);
    if (square < kThin * kThin || std::fabs(dot(normal, y)) > kRounding) return false;
    const double of_a = dot(cross(y, inverse(face.edge.to)), normal) / square;
    const double of_b = dot(cross(inverse(face.edge.from), y), normal) / square;
    return of_a > -kSlack && of_b > -kSlack && of_a + of_b < 1 - kMargin;
  });
}

// Decided exactly: is x, which inversion takes to y, on the open side of the face?
bool VolumeStar::in_front(const Face& face, const Point<3>& x, const Point<3>& y) const {
  if (face.common >= 0) {
    const auto k = static_cast<std::size_t>(face.common);
    return face.normal[k] * (x[k] - centre_.x[k]) > 0;
  }
  const double out = dot(face.normal, y);
  if (std::fabs(out) > kRounding) return out > 0;
  return orientation(centre_.x, candidates_[index(face.edge.from)].x,
                     candidates_[index(face.edge.to)].x, x) > 0;
}

bool VolumeStar::may_matter(const Point<3>& x) const {
  const Point<3> away = difference(x, centre_.x);
  const double square = dot(away, away), farthest = search_reach_ * kBeyond;
  if (square == 0 || square > farthest * farthest) return false;
  if (nothing_found_) return true;
  const double scale = unit_ / square;
  const Point<3> y{scale * away[0], scale * away[1], scale * away[2]};
  const bool beyond =
      std::any_of(unproven_.begin(), unproven_.end(),
                  [&](const Plane& plane) { return dot(plane.normal, y) > plane.offset; }) ||
      std::any_of(open_.begin(), open_.end(),
                  [&](const Face& face) { return in_front(face, x, y); });
  return beyond && !is_shielded(y);
}

std::uint64_t VolumeStar::may_matter_bits(const std::array<const double*, 3>& x,
                                          std::size_t n) const {
  const double *x0 = x[0], *x1 = x[1], *x2 = x[2];
  const double c0 = centre_.x[0], c1 = centre_.x[1], c2 = centre_.x[2];
  const double farthest = search_reach_ * kBeyond, unit = unit_;
  const std::uint64_t near = bits_where(n, [=](std::size_t k) {
    const double dx = x0[k] - c0, dy = x1[k] - c1, dz = x2[k] - c2;
    return dx * dx + dy * dy + dz * dz <= farthest * farthest;
  });
  if (nothing_found_ || near == 0) return near;
  std::uint64_t beyond = 0;
  const auto add_beyond = [&](const Point<3>& normal, double offset) {
    const double nx = normal[0], ny = normal[1], nz = normal[2];
    beyond |= bits_where(n, [=](std::size_t k) {
      const double dx = x0[k] - c0, dy = x1[k] - c1, dz = x2[k] - c2;
      return (nx * dx + ny * dy + nz * dz) * unit > offset * (dx * dx + dy * dy + dz * dz);
    });
  };
  for (const Plane& plane : unproven_) add_beyond(plane.normal, plane.offset - kRounding);
  for (const Face& face : open_) {
    if (face.common < 0) {
      add_beyond(face.normal, -2 * kRounding);
      continue;
    }
    const auto k = static_cast<std::size_t>(face.common);
    const double* const along = x[k];
    const double c = centre_.x[k], sign = std::copysign(1.0, face.normal[k]);
    beyond |= bits_where(n, [=](std::size_t j) { return sign * (along[j] - c) > 0; });
  }
  return near & beyond;
}

bool VolumeStar::may_matter_in(const Box<3>& box) const {
  const Point<3> low = difference(box.low, centre_.x), high = difference(box.high, centre_.x);
  double nearest = 0, farthest = 0;  // squares
  for (std::size_t k = 0; k < 3; ++k) {
    const double gap = std::max({low[k], -high[k], 0.0});
    nearest += gap * gap;
    farthest += std::max(low[k] * low[k], high[k] * high[k]);
  }
  if (nearest > search_reach_ * search_reach_ * kBeyond) return false;
  if (nothing_found_) return true;
  // Is normal * x > offset * |x|^2, in their unit of length, for the best x in the box?
  const double slack = 1e-9 * farthest / unit_;
  const auto reaches = [&](const Point<3>& normal, double offset) {
    const double bend = std::max(offset, 0.0) / unit_;
    double sum = slack;
    for (std::size_t k = 0; k < 3; ++k) {
      constexpr double kInfinity = std::numeric_limits<double>::infinity();
      const double peak = bend > 0 ? 0.5 * normal[k] / bend : std::copysign(kInfinity, normal[k]);
      const double x = std::clamp(peak, low[k], high[k]);
      sum += normal[k] * x - bend * x * x;
    }
    return sum > 0;
  };
  return std::any_of(unproven_.begin(), unproven_.end(),
                     [&](const Plane& plane) { return reaches(plane.normal, plane.offset); }) ||
         std::any_of(open_.begin(), open_.end(),
                     [&](const Face& face) { return reaches(face.normal, 0); });
}

}  // namespace pnpbs
