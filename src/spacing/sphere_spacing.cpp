// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/sphere_spacing.hpp"

#include <cmath>

#include "base/error.hpp"
#include "base/point_text.hpp"

namespace pnpbs {

void SphereSpacing::evaluate(std::int64_t n, const Point<2>* u, double* d) const {
  for_points_on_sphere(
      chart_, n, u, [&](std::int64_t begin, std::int64_t count, const Point<3>* x) {
        along_->evaluate(count, x, d + begin);
        for (std::int64_t i = 0; i < count; ++i) {
          double& value = d[begin + i];
          if (!std::isfinite(value) || value <= 0)
            throw Error(ErrorKind::spacing, "the spacing at " + point_text(u[begin + i]) + " is " +
                                                number_text(value) +
                                                "; it must be finite and greater than 0");
          value *= chart_.stretch(u[begin + i]);
        }
      });
}

// Omits points so close to the chart's projection point that the chart cannot represent them.
SpacingHints<2> SphereSpacing::spacing_hints() const {
  const SpacingHints<3> along = along_->spacing_hints();
  SpacingHints<2> known;
  const auto add = [&](const Point<3>& x, const auto& take) {
    const Point<2> u = chart_.in_chart(x);
    const double stretch = chart_.stretch(u);
    if (stretch < StereographicChart::kMaxStretch) take(u, stretch);
  };
  for (const GrowthSource<3>& value : along.values)
    add(value.x, [&](const Point<2>& u, double stretch) {
      known.values.push_back({u, stretch * value.d});
    });
  for (const auto& slope : along.slopes)
    add(slope.at, [&](const Point<2>& u, double stretch) {
      known.slopes.push_back({slope.growth, stretch * slope.d, u});
    });
  return known;
}

std::optional<GivenExtent<2>> SphereSpacing::extent() const {
  const std::optional<GivenExtent<3>> along = along_->extent();
  if (!along) return std::nullopt;
  return GivenExtent<2>{along->name, along->beyond, {}, along->on_sphere};
}

void SphereSpacing::distance_to_extent(std::int64_t n, const Point<2>* u, double* distances) const {
  for_points_on_sphere(chart_, n, u,
                       [&](std::int64_t begin, std::int64_t count, const Point<3>* x) {
                         along_->distance_to_extent(count, x, distances + begin);
                       });
  for (std::int64_t i = 0; i < n; ++i) distances[i] *= chart_.stretch(u[i]);
}

}  // namespace pnpbs
