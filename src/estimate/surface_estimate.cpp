// SPDX-License-Identifier: BSD-3-Clause
#include "estimate/surface_estimate.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/lattice.hpp"
#include "base/space_vectors.hpp"

namespace pnpbs {

namespace {

// Samples of d in a triangle: its centroid and three points around it.
constexpr std::size_t kSamples = 4;

std::array<Point<3>, kSamples> samples_in(const FacetCorners<3>& x) {
  const Point<3> middle = shifted(x[0], 2.0 / 3, difference(halfway(x[1], x[2]), x[0]));
  return {middle, halfway(middle, x[0]), halfway(middle, x[1]), halfway(middle, x[2])};
}

double area_of(const FacetCorners<3>& x) {
  return 0.5 * length(cross(difference(x[1], x[0]), difference(x[2], x[0])));
}

void append_quarters(const FacetCorners<3>& x, std::vector<FacetCorners<3>>& triangles) {
  const Point<3> ab = halfway(x[0], x[1]), bc = halfway(x[1], x[2]), ca = halfway(x[2], x[0]);
  triangles.insert(triangles.end(), {{x[0], ab, ca}, {ab, x[1], bc}, {ca, bc, x[2]}, {ab, bc, ca}});
}

struct Sampled {
  double nodes;      // Number of nodes from the mean density of the samples.
  double variation;  // Ratio of the largest to the smallest d of the samples.
};

std::vector<Sampled> sampled(const std::vector<FacetCorners<3>>& triangles,
                             const SpacingEvaluator<3>& spacing) {
  std::vector<Point<3>> points;
  for (const FacetCorners<3>& triangle : triangles)
    for (const Point<3>& x : samples_in(triangle)) points.push_back(x);
  std::vector<double> d(points.size());
  spacing(std::ssize(points), points.data(), d.data());
  std::vector<Sampled> results;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const double* const own = d.data() + kSamples * t;
    const auto [min, max] = std::minmax_element(own, own + kSamples);
    double density = 0;
    for (std::size_t s = 0; s < kSamples; ++s) density += 1 / (own[s] * own[s]);
    results.push_back(
        {Lattice<2>::kDensity * area_of(triangles[t]) * density / kSamples, *max / *min});
  }
  return results;
}

}  // namespace

double nodes_on_triangles(std::vector<FacetCorners<3>> triangles,
                          const SpacingEvaluator<3>& spacing) {
  constexpr int kMaxRounds = 10;
  constexpr double kEven = 1.1;       // Largest variation for which the mean is accurate.
  constexpr double kFewNodes = 5e-4;  // Largest share of a triangle that is not subdivided.
  double kept = 0;                    // Nodes in triangles that need no further subdivision.
  for (int round = 0;; ++round) {
    const std::vector<Sampled> samples = sampled(triangles, spacing);
    double all = kept;
    for (const Sampled& triangle : samples) all += triangle.nodes;
    std::vector<FacetCorners<3>> next;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const bool divide = samples[t].variation > kEven && samples[t].nodes > kFewNodes * all;
      if (divide && round < kMaxRounds)
        append_quarters(triangles[t], next);
      else
        kept += samples[t].nodes;
    }
    if (next.empty()) return kept;
    triangles = std::move(next);
  }
}

}  // namespace pnpbs
