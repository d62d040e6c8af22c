// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/sphere_cloud_spacing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/space_vectors.hpp"
#include "sphere/great_circle.hpp"

namespace pnpbs {

SphereCloudSpacing::SphereCloudSpacing(const SphereField& field, double radius)
    : CloudSpacing<3, 2>(field), radius_(radius), middle_{}, angle_(std::numbers::pi) {
  for (const Point<3>& x : field.points) middle_ = shifted(middle_, 1 / radius, x);
  constexpr double kOnePlace = 1e-9;
  double widest = 0;
  for (const Point<3>& x : field.points) widest = std::max(widest, angle_between(middle_, x));
  if (widest > kOnePlace)
    angle_ = widest + 2 * widest / std::sqrt(static_cast<double>(field.points.size()));
}

std::optional<GivenExtent<3>> SphereCloudSpacing::extent() const {
  return GivenExtent<3>{"cloud of points", "d is near that of the nearest points", {}};
}

void SphereCloudSpacing::distance_to_extent(std::int64_t n, const Point<3>* x,
                                            double* distances) const {
  for (std::int64_t i = 0; i < n; ++i)
    distances[i] = radius_ * std::max(0.0, angle_between(middle_, x[i]) - angle_);
}

}  // namespace pnpbs
