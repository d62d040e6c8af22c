// SPDX-License-Identifier: BSD-3-Clause
#include "implicit/measured_repair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/index.hpp"
#include "base/space_vectors.hpp"
#include "base/started_execution.hpp"

namespace pnpbs {

namespace {

using TriangleList = std::vector<FacetCorners<3>>;
using Nearest = NearestTriangles::Nearest;

struct Sample {
  Point<3> x, normal;  // unit, of the triangle
  double area;         // that it stands for; 0 of corners
};

double area_of(const FacetCorners<3>& triangle) { return length(area_normal(triangle)); }

// The middles of pieces no longer than `apart`, made by halving the longest edge.
void add_middles(const FacetCorners<3>& triangle, const Point<3>& normal, double apart,
                 std::vector<Sample>& samples) {
  std::array<double, 3> square;  // of the edge from corner k to the next
  for (std::size_t k = 0; k < 3; ++k)
    square[k] = squared_distance<3>(triangle[k], triangle[(k + 1) % 3]);
  const auto k =
      static_cast<std::size_t>(std::max_element(square.begin(), square.end()) - square.begin());
  if (!(square[k] > apart * apart)) {
    samples.push_back({centroid(triangle), normal, area_of(triangle)});
    return;
  }
  const Point<3>&a = triangle[k], &b = triangle[(k + 1) % 3], &c = triangle[(k + 2) % 3];
  const Point<3> half = shifted(a, 0.5, difference(b, a));
  add_middles({a, half, c}, normal, apart, samples);
  add_middles({half, b, c}, normal, apart, samples);
}

std::vector<Sample> samples_on(const TriangleList& triangles, double apart) {
  std::vector<Sample> samples;
  for (const FacetCorners<3>& triangle : triangles) {
    const Point<3> normal = unit_vector(area_normal(triangle));
    for (const Point<3>& corner : triangle) samples.push_back({corner, normal, 0});
    add_middles(triangle, normal, apart, samples);
  }
  return samples;
}

std::vector<Nearest> nearest_to(const std::vector<Sample>& samples,
                                const NearestTriangles& triangles) {
  std::vector<Nearest> nearest(samples.size());
  for_each_if_started("pnpbs::distances_of_repair", std::ssize(samples), [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    nearest[k] = triangles.nearest(samples[k].x);
  });
  return nearest;
}

TriangleList triangles_of(const SurfaceSource& surface) {
  TriangleList triangles;
  for (const auto& [a, b, c] : surface.triangles)
    triangles.push_back(
        {surface.vertices[index(a)], surface.vertices[index(b)], surface.vertices[index(c)]});
  return triangles;
}

// Does the way to the nearest point run along the surface rather than off it? So it does where a
// hole is closed: what is nearest lies beside.
bool closes_a_hole(const Sample& sample, const Nearest& nearest, double resolution) {
  constexpr double kNoWay = 1e-3;  // resolutions: rounding has no direction
  if (nearest.square < kNoWay * kNoWay * resolution * resolution) return false;
  const Point<3> way = difference(nearest.point.x, sample.x);
  const double off = dot(way, sample.normal);
  return 2 * off * off < nearest.square;
}

void measure_new(const std::vector<Sample>& samples, const std::vector<Nearest>& nearest,
                 RepairDistances& found) {
  double area = 0, sum = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double away = std::sqrt(nearest[k].square);
    double& largest =
        closes_a_hole(samples[k], nearest[k], found.resolution) ? found.over_holes : found.to_given;
    largest = std::max(largest, away);
    sum += samples[k].area * away;
    area += samples[k].area;
  }
  found.mean_to_given = area > 0 ? sum / area : 0;
}

void measure_given(const std::vector<Sample>& samples, const std::vector<Nearest>& nearest,
                   RepairDistances& found) {
  double all = 0, lost = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double away = std::sqrt(nearest[k].square);
    found.to_new = std::max(found.to_new, away);
    all += samples[k].area;
    if (away > found.resolution) lost += samples[k].area;
  }
  found.lost = all > 0 ? lost / all : 0;
}

}  // namespace

RepairDistances distances_of_repair(const NearestTriangles& given, const SurfaceSource& made,
                                    double resolution) {
  RepairDistances found{.resolution = resolution};
  const NearestTriangles made_ones(triangles_of(made));
  const std::vector<Sample> on_new = samples_on(made_ones.triangles(), resolution),
                            on_given = samples_on(given.triangles(), resolution);
  measure_new(on_new, nearest_to(on_new, given), found);
  measure_given(on_given, nearest_to(on_given, made_ones), found);
  return found;
}

}  // namespace pnpbs
