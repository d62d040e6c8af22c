// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/volume/winding_number.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/limits.hpp"
#include "base/space_vectors.hpp"
#include "geometry/volume/triangles.hpp"

namespace pnpbs {

namespace {

constexpr std::int32_t kCellTriangles = 4;
// Distance from which on a cell is replaced by its series. [radius of the cell]
constexpr double kFar = 2.5;
constexpr double kSphere = 4 * std::numbers::pi;

// Returns atan2(y, x), by its series with an error of 1e-9 for small angles. Most triangles are
// seen under small angles.
double angle_of(double y, double x) {
  if (!(std::fabs(y) < 0.2 * x)) return std::atan2(y, x);
  const double t = y / x, q = t * t;
  return t * (1 - q * (1.0 / 3 - q * (1.0 / 5 - q * (1.0 / 7 - q * (1.0 / 9 - q / 11)))));
}

}  // namespace

double winding_of(const FacetCorners<3>& triangle, const Point<3>& x) {
  const Point<3> a = difference(triangle[0], x), b = difference(triangle[1], x),
                 c = difference(triangle[2], x);
  const double la = length(a), lb = length(b), lc = length(c);
  const double volume = dot(a, cross(b, c));
  const double sides = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  return volume == 0 ? 0 : 2 * angle_of(volume, sides) / kSphere;
}

WindingNumber::WindingNumber(std::vector<FacetCorners<3>> triangles)
    : triangles_(std::move(triangles)) {
  if (triangles_.empty()) return;
  cells_.push_back({.begin = 0, .end = static_cast<std::int32_t>(triangles_.size())});
  for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
    describe(cells_[cell]);
    split(cell);
  }
}

void WindingNumber::describe(Cell& cell) const {
  double sum = 0;
  for (std::int32_t t = cell.begin; t < cell.end; ++t) {
    const FacetCorners<3>& triangle = triangles_[static_cast<std::size_t>(t)];
    const Point<3> area = area_normal(triangle);
    cell.area = shifted(cell.area, 1, area);
    cell.middle = shifted(cell.middle, length(area), centroid(triangle));
    sum += length(area);
  }
  cell.middle = sum > 0 ? shifted({}, 1 / sum, cell.middle)
                        : triangles_[static_cast<std::size_t>(cell.begin)][0];
  for (std::int32_t t = cell.begin; t < cell.end; ++t) {
    const FacetCorners<3>& triangle = triangles_[static_cast<std::size_t>(t)];
    const Point<3> area = area_normal(triangle), way = difference(centroid(triangle), cell.middle);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) cell.moments[i][j] += area[i] * way[j];
  }
  for (std::int32_t t = cell.begin; t < cell.end; ++t)
    for (const Point<3>& corner : triangles_[static_cast<std::size_t>(t)])
      cell.radius = std::max(cell.radius, distance<3>(corner, cell.middle));
}

// Splits a cell into halves across the longest side of the bounding box of the centroids.
void WindingNumber::split(std::size_t c) {
  const auto [begin, end] = std::pair(cells_[c].begin, cells_[c].end);
  if (end - begin <= kCellTriangles) return;
  Box<3> box = empty_box<3>();
  for (std::int32_t t = begin; t < end; ++t)
    include(box, centroid(triangles_[static_cast<std::size_t>(t)]));
  std::size_t k = 0;
  for (const std::size_t other : {1, 2})
    if (box.high[k] - box.low[k] < box.high[other] - box.low[other]) k = other;
  const std::int32_t middle = begin + (end - begin) / 2;
  std::nth_element(triangles_.begin() + begin, triangles_.begin() + middle,
                   triangles_.begin() + end,
                   [&](const FacetCorners<3>& a, const FacetCorners<3>& b) {
                     return centroid(a)[k] < centroid(b)[k];
                   });
  cells_[c].child = static_cast<std::int32_t>(cells_.size());
  cells_.push_back({.begin = begin, .end = middle});
  cells_.push_back({.begin = middle, .end = end});
}

double WindingNumber::of_cell(std::int32_t c, const Point<3>& x) const {
  const Cell& cell = cells_[static_cast<std::size_t>(c)];
  const Point<3> way = difference(cell.middle, x);
  const double square = dot(way, way);
  if (square > kFar * kFar * cell.radius * cell.radius) {
    const auto& m = cell.moments;
    const double trace = m[0][0] + m[1][1] + m[2][2];
    const double along =
        way[0] * dot(m[0], way) + way[1] * dot(m[1], way) + way[2] * dot(m[2], way);
    return (dot(cell.area, way) + trace - 3 * along / square) /
           (kSphere * square * std::sqrt(square));
  }
  if (cell.child >= 0) return of_cell(cell.child, x) + of_cell(cell.child + 1, x);
  double sum = 0;
  for (std::int32_t t = cell.begin; t < cell.end; ++t)
    sum += winding_of(triangles_[static_cast<std::size_t>(t)], x);
  return sum;
}

}  // namespace pnpbs
