// SPDX-License-Identifier: BSD-3-Clause
#include "quality/plane/obtuse_triangles.hpp"

#include <algorithm>
#include <cmath>

#include "method/constants.hpp"

namespace pnpbs {

namespace {

constexpr double kRadians = 3.14159265358979323846 / 180;

// Returns the cosine of the largest angle of a triangle with these squared side lengths. Returns a
// smaller value if the smallest angle is worse: sin(smallest) / sin(kObtuseRepairMinAngle) - 1, so
// that an angle of kObtuseRepairMinAngle is as bad as a right angle.
double value_of(double aa, double bb, double cc) {
  const auto cosine = [](double opposite, double b, double c) {
    return (b + c - opposite) / (2 * std::sqrt(b * c));
  };
  const double at_a = cosine(aa, bb, cc), at_b = cosine(bb, cc, aa), at_c = cosine(cc, aa, bb);
  const double smallest = std::max({at_a, at_b, at_c}), largest = std::min({at_a, at_b, at_c});
  const double sine = std::sqrt(std::max(0.0, 1 - smallest * smallest));
  return std::min(largest, sine / std::sin(kRadians * method::kObtuseRepairMinAngle) - 1);
}

template <int N>
double value_of(const Point<N>& a, const Point<N>& b, const Point<N>& c) {
  return value_of(squared_distance<N>(b, c), squared_distance<N>(c, a), squared_distance<N>(a, b));
}

}  // namespace

TriangleMeasure measure_of_obtuse_triangles(const Embedding<2>& embedding) {
  constexpr double kTurnedOver = -2;
  // An upper bound of the quality of bad triangles, which is largest for isosceles ones. The margin
  // accounts for the distortion of angles of large triangles in a chart.
  constexpr double kSufficientQuality = 0.9;
  const auto value = [embedding](const Point<2>& a, const Point<2>& b, const Point<2>& c) {
    const double twice_area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if (twice_area <= 0) return kTurnedOver;
    if (!embedding.is_sphere()) return value_of<2>(a, b, c);
    return value_of<3>(embedding.in_space(a), embedding.in_space(b), embedding.in_space(c));
  };
  return {value, std::cos(kRadians * method::kObtuseRepairAngle), kSufficientQuality};
}

}  // namespace pnpbs
