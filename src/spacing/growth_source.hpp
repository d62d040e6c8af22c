// SPDX-License-Identifier: BSD-3-Clause
// What limits a spacing whose growth is limited: in the leaves of a tree, the least by far seen.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "base/types.hpp"
#include "sphere/stereographic_chart.hpp"

namespace pnpbs {

// A point that limits d around it: d there is at most this.
template <int Dim>
struct GrowthSource {
  Point<Dim> x{};
  double d = std::numeric_limits<double>::infinity();

  double limit(const Point<Dim>& at, double growth) const {
    return d + growth * distance<Dim>(x, at);
  }
};

// Growth by which a known value is seen from the cell_samples of a leaf: no place in the leaf is
// farther than 0.44 sides from one of these, so that the value is below a quarter of the side there
// if the leaf is much too wide for it.
inline constexpr double kSeenFromSamples = 0.3;

// What limits d in a leaf, and how far at the place that stands for the leaf. In a total order, so
// that the least of several is the same in whatever order they come.
template <int Dim>
struct GrowthLabel {
  double value = std::numeric_limits<double>::infinity();
  GrowthSource<Dim> source;

  bool operator<(const GrowthLabel& other) const {
    return std::tie(value, source.d, source.x) <
           std::tie(other.value, other.source.d, other.source.x);
  }
};

// By how much d may grow per unit of length: in the chart of a sphere, d and lengths are those
// along the sphere.
template <int Dim>
struct GrowthRule {
  double growth = 0;
  std::optional<StereographicChart> chart{};  // in the plane

  GrowthRule(double most = 0, const StereographicChart* of = nullptr) : growth(most) {
    if (of) chart = *of;
  }

  // What d is at most at a point, with this source.
  double limit(const GrowthSource<Dim>& source, const Point<Dim>& at) const {
    if constexpr (Dim == 2)
      if (chart)
        return chart->stretch(at) *
               (source.d / chart->stretch(source.x) + growth * chart->distance(source.x, at));
    return source.limit(at, growth);
  }

  // Between points with those d.
  double between(const Point<Dim>& x, double d_x, const Point<Dim>& y, double d_y) const {
    if constexpr (Dim == 2)
      if (chart)
        return std::abs(d_x / chart->stretch(x) - d_y / chart->stretch(y)) / chart->distance(x, y);
    return std::abs(d_x - d_y) / distance<Dim>(x, y);
  }
};

template <int Dim>
GrowthLabel<Dim> label_at(const Point<Dim>& place, const GrowthSource<Dim>& source,
                          const GrowthRule<Dim>& rule) {
  return {rule.limit(source, place), source};
}

}  // namespace pnpbs
