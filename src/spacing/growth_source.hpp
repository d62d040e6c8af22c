// SPDX-License-Identifier: BSD-3-Clause
// What limits a spacing whose growth is limited: in the leaves of a tree, the least by far seen.
#pragma once

#include <cmath>
#include <limits>
#include <tuple>

#include "base/types.hpp"
#include "sphere/embedding.hpp"

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

// By how much d may grow per unit of length, both as users measure them.
template <int Dim>
struct GrowthRule {
  double growth = 0;
  Embedding<Dim> embedding{};

  GrowthRule(double most = 0, const Embedding<Dim>& of = {}) : growth(most), embedding(of) {}

  // What d is at most at a point, with this source.
  double limit(const GrowthSource<Dim>& source, const Point<Dim>& at) const {
    return embedding.coordinate_length(at, embedding.measured_length(source.x, source.d) +
                                               growth * embedding.distance(source.x, at));
  }

  // Between points with those d.
  double between(const Point<Dim>& x, double d_x, const Point<Dim>& y, double d_y) const {
    return std::abs(embedding.measured_length(x, d_x) - embedding.measured_length(y, d_y)) /
           embedding.distance(x, y);
  }
};

template <int Dim>
GrowthLabel<Dim> label_at(const Point<Dim>& place, const GrowthSource<Dim>& source,
                          const GrowthRule<Dim>& rule) {
  return {rule.limit(source, place), source};
}

}  // namespace pnpbs
