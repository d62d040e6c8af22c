// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/volume/welding.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "base/limits.hpp"
#include "base/mixed_hash.hpp"

namespace pnpbs {

namespace {

// Width of a cell of the hash grid. [tolerances] It is large enough that few points are near a
// border, and small enough that few points share a cell.
constexpr double kCell = 1024;

struct CellHash {
  std::size_t operator()(const std::array<std::int64_t, 3>& cell) const {
    std::uint64_t hash = 0;
    for (const std::int64_t k : cell) hash = mixed(hash ^ static_cast<std::uint64_t>(k));
    return hash;
  }
};

// A hash grid of the points that are not merged.
class Places {
 public:
  Places(std::span<const Point<3>> points, double tolerance)
      : points_(points), tolerance_(tolerance), next_(points.size()), low_(points[0]) {
    Box<3> box = empty_box<3>();
    for (const Point<3>& x : points) include(box, x);
    low_ = box.low;
  }

  void add(std::int32_t p) {
    const auto [entry, is_new] = first_.try_emplace(cell_of(points_[p], 0), -1);
    next_[p] = entry->second;
    entry->second = p;
  }

  // Returns the nearest point within the tolerance, the first one if there are several, or -1 if
  // none.
  std::int32_t nearest(std::int32_t p) const {
    const std::array<std::int64_t, 3> low = cell_of(points_[p], -tolerance_),
                                      high = cell_of(points_[p], tolerance_);
    std::int32_t nearest = -1;
    double least = tolerance_;
    for (std::array<std::int64_t, 3> cell = low; cell[0] <= high[0]; ++cell[0])
      for (cell[1] = low[1]; cell[1] <= high[1]; ++cell[1])
        for (cell[2] = low[2]; cell[2] <= high[2]; ++cell[2]) {
          const auto entry = first_.find(cell);
          if (entry == first_.end()) continue;
          for (std::int32_t other = entry->second; other >= 0; other = next_[other]) {
            const double gap = distance<3>(points_[other], points_[p]);
            if (gap > least || (gap == least && nearest >= 0 && other > nearest)) continue;
            least = gap;
            nearest = other;
          }
        }
    return nearest;
  }

 private:
  std::array<std::int64_t, 3> cell_of(const Point<3>& x, double shift) const {
    std::array<std::int64_t, 3> cell;
    for (int k = 0; k < 3; ++k) {
      const double along = (x[k] + shift - low_[k]) / (kCell * tolerance_);
      cell[k] = std::llround(std::clamp(along, -0x1p60, 0x1p60));
    }
    return cell;
  }

  std::span<const Point<3>> points_;
  double tolerance_;
  std::unordered_map<std::array<std::int64_t, 3>, std::int32_t, CellHash> first_;
  std::vector<std::int32_t> next_;
  Point<3> low_;
};

// Returns for each point the first point with exactly the same position.
std::vector<std::int32_t> first_at_place(std::span<const Point<3>> points) {
  std::vector<std::int32_t> order(points.size()), first(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return points[a] != points[b] ? points[a] < points[b] : a < b;
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && points[order[i]] == points[order[i - 1]];
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

}  // namespace

std::vector<std::int32_t> weld_points(std::span<const Point<3>> points, double tolerance) {
  std::vector<std::int32_t> joined = first_at_place(points);
  if (!(tolerance > 0)) return joined;
  Places places(points, tolerance);
  for (std::int32_t p = 0; p < static_cast<std::int32_t>(points.size()); ++p) {
    if (joined[p] != p) {
      joined[p] = joined[joined[p]];
      continue;
    }
    const std::int32_t nearest = places.nearest(p);
    if (nearest >= 0) {
      joined[p] = nearest;
    } else {
      places.add(p);
    }
  }
  return joined;
}

}  // namespace pnpbs
