// SPDX-License-Identifier: BSD-3-Clause
// Sources, labels and rules by which the growth of a spacing is limited.
#pragma once

#include <cmath>
#include <limits>
#include <tuple>

#include "base/types.hpp"
#include "sphere/embedding.hpp"

namespace pnpbs {

// A point with a value that limits d around it.
template <int Dim>
struct GrowthSource {
  Point<Dim> x{};
  double d = std::numeric_limits<double>::infinity();

  // Returns the upper bound of d at a point, for lengths in coordinates.
  double limit(const Point<Dim>& at, double growth) const {
    return d + growth * distance<Dim>(x, at);
  }
};

// Growth of d assumed around known values when they are compared with the cell_samples of a leaf.
// [d per d] Derived: no point of a leaf is farther than 0.44 sides from a sample, so a leaf much
// too wide for the value has a sample with a bound below a quarter of its side.
inline constexpr double kSeenFromSamples = 0.3;

// The source that limits d in a leaf, and its limit at the representative point of the leaf. Labels
// have a total order, so the smallest of several does not depend on their order.
template <int Dim>
struct GrowthLabel {
  double value = std::numeric_limits<double>::infinity();
  GrowthSource<Dim> source;

  bool operator<(const GrowthLabel& other) const {
    return std::tie(value, source.d, source.x) <
           std::tie(other.value, other.source.d, other.source.x);
  }
};

// The largest growth of d per unit of length, both as users measure them.
template <int Dim>
struct GrowthRule {
  double growth = 0;
  Embedding<Dim> embedding{};

  GrowthRule(double most = 0, const Embedding<Dim>& of = {}) : growth(most), embedding(of) {}

  // Returns the upper bound of d at a point, imposed by this source.
  double limit(const GrowthSource<Dim>& source, const Point<Dim>& at) const {
    return embedding.coordinate_length(at, embedding.measured_length(source.x, source.d) +
                                               growth * embedding.distance(source.x, at));
  }

  // Returns the growth between two points with these d.
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
