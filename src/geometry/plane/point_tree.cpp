// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane/point_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "geometry/plane/segments.hpp"

namespace pnpbs {

namespace {

constexpr std::int32_t kLeafSize = 8;

// Returns whether a point of the box may be within reach of the segment. It can return true if none
// is, but never false if one is.
bool may_be_near(const Box<2>& box, const Point<2>& a, const Point<2>& b, double reach) {
  for (const int k : {0, 1}) {
    if (std::max(a[k], b[k]) + reach < box.low[k]) return false;
    if (std::min(a[k], b[k]) - reach > box.high[k]) return false;
  }
  const double dx = b[0] - a[0], dy = b[1] - a[1];
  const double mx = 0.5 * box.low[0] + 0.5 * box.high[0] - a[0];
  const double my = 0.5 * box.low[1] + 0.5 * box.high[1] - a[1];
  const double half_x = 0.5 * (box.high[0] - box.low[0]) + reach;
  const double half_y = 0.5 * (box.high[1] - box.low[1]) + reach;
  const double slack = 1e-12 * (std::fabs(dx * my) + std::fabs(dy * mx));
  return std::fabs(dx * my - dy * mx) <= half_x * std::fabs(dy) + half_y * std::fabs(dx) + slack;
}

}  // namespace

PointTree::PointTree(std::vector<Point<2>> points)
    : points_(std::move(points)), order_(points_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  cells_.push_back({{}, 0, static_cast<std::int32_t>(points_.size()), -1});
  for (std::size_t cell = 0; cell < cells_.size(); ++cell) split(static_cast<std::int32_t>(cell));
}

void PointTree::split(std::int32_t cell) {
  const std::int32_t begin = cells_[cell].begin, end = cells_[cell].end;
  if (begin == end) return;
  Box<2> box{points_[order_[begin]], points_[order_[begin]]};
  for (std::int32_t i = begin; i < end; ++i) {
    for (const int k : {0, 1}) {
      box.low[k] = std::min(box.low[k], points_[order_[i]][k]);
      box.high[k] = std::max(box.high[k], points_[order_[i]][k]);
    }
  }
  cells_[cell].box = box;
  if (end - begin <= kLeafSize) return;
  const int k = box.high[0] - box.low[0] >= box.high[1] - box.low[1] ? 0 : 1;
  const std::int32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [this, k](std::int32_t a, std::int32_t b) {
                     return points_[a][k] != points_[b][k] ? points_[a][k] < points_[b][k] : a < b;
                   });
  cells_[cell].child = static_cast<std::int32_t>(cells_.size());
  cells_.push_back({{}, begin, middle, -1});
  cells_.push_back({{}, middle, end, -1});
}

void PointTree::for_each_near(
    const Point<2>& a, const Point<2>& b, double reach,
    const std::function<void(std::int32_t point, double distance)>& found) const {
  if (points_.empty()) return;
  std::vector<std::int32_t> open{0};
  while (!open.empty()) {
    const Cell& cell = cells_[open.back()];
    open.pop_back();
    if (!may_be_near(cell.box, a, b, reach)) continue;
    if (cell.child >= 0) {
      open.push_back(cell.child + 1);
      open.push_back(cell.child);
      continue;
    }
    for (std::int32_t i = cell.begin; i < cell.end; ++i) {
      const double d = distance_to_segment(a, b, points_[order_[i]]);
      if (d <= reach) found(order_[i], d);
    }
  }
}

}  // namespace pnpbs
