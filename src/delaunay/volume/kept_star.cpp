// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/volume/kept_star.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/space_vectors.hpp"
#include "delaunay/volume/domain_rule.hpp"
#include "delaunay/volume/element_rule.hpp"

namespace pnpbs {

namespace {

// Of a difference of positions each component is right up to half an ulp. With edges no longer than
// 1, a volume (six times that of the tetrahedron) is then wrong by less than 60 half ulps, and what
// tells on which side of a sphere a point is, by less than 300.
constexpr double kRounding = 0x1p-44;

}  // namespace

// Positions, triangles and what is beyond their edges. Is the star fit to be looked at?
bool KeptStar::gather(std::int64_t i) {
  nodes_.clear();
  to_.clear();
  squares_.clear();
  triangles_.clear();
  const std::int32_t n = stars_.size(i);
  if (n > kMaxNeighbours || !stars_.closed(i)) return false;
  const Point<3> x = in_.nodes.position(i);
  double longest = 0;
  stars_.for_neighbours(i, [&](std::int64_t j) {
    nodes_.push_back(static_cast<std::int32_t>(j));
    to_.push_back(difference(in_.nodes.position(j), x));
    squares_.push_back(dot(to_.back(), to_.back()));
    longest = std::max(longest, squares_.back());
  });
  const double length = std::sqrt(longest);
  volume_error_ = kRounding * longest * length;
  sphere_error_ = volume_error_ * longest;
  for (std::int32_t p = 0; p < n; ++p)
    std::fill_n(third_.begin() + p * kMaxNeighbours, n, std::int8_t{-1});
  stars_.for_triangles_of_places(i, [&](const Corners& triangle) {
    triangles_.push_back(triangle);
    for (std::size_t k = 0; k < 3; ++k)
      third_[index(triangle[k] * kMaxNeighbours + triangle[(k + 1) % 3])] =
          static_cast<std::int8_t>(triangle[(k + 2) % 3]);
  });
  return true;
}

KeptStar::Sphere KeptStar::sphere_of(const Corners& triangle) const {
  const std::size_t a = index(triangle[0]), b = index(triangle[1]), c = index(triangle[2]);
  const Point<3> bc = cross(to_[b], to_[c]), ca = cross(to_[c], to_[a]), ab = cross(to_[a], to_[b]);
  Sphere sphere{{}, dot(to_[a], bc)};
  for (std::size_t k = 0; k < 3; ++k)
    sphere.normal[k] = squares_[a] * bc[k] + squares_[b] * ca[k] + squares_[c] * ab[k];
  return sphere;
}

bool KeptStar::surely_outside(const Sphere& sphere, std::int32_t place) const {
  const std::size_t k = index(place);
  return sphere.volume * squares_[k] - dot(sphere.normal, to_[k]) > sphere_error_;
}

// One of the domain, surely of positive orientation, and surely small enough.
bool KeptStar::is_tetrahedron(std::int64_t i, const Corners& triangle, const Sphere& sphere) const {
  constexpr double kSurely = 0.999;
  if (!(sphere.volume > volume_error_)) return false;
  double d = in_.nodes.d(i);
  for (const std::int32_t place : triangle) d = std::min(d, in_.nodes.d(node(place)));
  const double limit = kSurely * 2 * kMaxRadius * d * sphere.volume;
  return dot(sphere.normal, sphere.normal) < limit * limit &&
         in_domain(in_, {i, node(triangle[0]), node(triangle[1]), node(triangle[2])});
}

}  // namespace pnpbs
