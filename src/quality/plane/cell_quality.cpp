// SPDX-License-Identifier: BSD-3-Clause
#include "quality/plane/cell_quality.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "base/execution.hpp"
#include "base/fixed_point.hpp"
#include "quality/plane/cell_centroids.hpp"
#include "quality/triangle_quality.hpp"

namespace pnpbs {

namespace {

// Is the angle obtuse at a corner of a triangle? In the plane as it is, or in space on a sphere.
bool is_obtuse_at(const MeasuredNodes<2>& measured, std::int64_t corner, std::int64_t i,
                  std::int64_t j) {
  const auto obtuse = [&](auto x) {
    measured.put(corner, x[0]);
    measured.put(i, x[1]);
    measured.put(j, x[2]);
    return is_obtuse(angle_cosine(x[0], x[1], x[2]));
  };
  return measured.chart ? obtuse(std::array<Point<3>, 3>()) : obtuse(std::array<Point<2>, 3>());
}

// Of the edges that have node i as the end with the lesser id: the Voronoi edge begins and ends on
// the same side of an edge if one of its two triangles is obtuse opposite to it.
int uncrossed_from(const MeasuredNodes<2>& measured, const DelaunayStars& stars, std::int64_t i) {
  int found = 0;
  stars.for_simplices(i, [&](const DelaunayStars::Corners& right) {
    const std::int64_t j = right[1];
    if (measured.nodes.id(j) < measured.nodes.id(i)) return;
    stars.for_simplices(i, [&](const DelaunayStars::Corners& left) {
      if (left[0] != j) return;
      found += is_obtuse_at(measured, right[0], i, j) || is_obtuse_at(measured, left[1], i, j);
    });
  });
  return found;
}

struct CellSums {
  std::int64_t cells = 0, uncrossed = 0;
  FixedPointSum offset;
  double max = 0;

  void add(const CellSums& other) {
    cells += other.cells;
    uncrossed += other.uncrossed;
    offset.add(other.offset);
    max = std::max(max, other.max);
  }
};

}  // namespace

CellQuality measure_cells(const Communicator& comm, const MeasuredNodes<2>& measured,
                          const DelaunayStars& stars) {
  const Nodes<2>& nodes = measured.nodes;
  const CellCentroids centroids(nodes, stars, measured.chart);
  const CellSums own = sums_over(
      "pnpbs::measure_cells", nodes.count, CellSums(), [&](std::int64_t i, CellSums& sums) {
        if (!nodes.owned(i)) return;
        sums.uncrossed += uncrossed_from(measured, stars, i);
        if (!centroids.has(i)) return;
        const double offset = measured.distance_to(i, centroids.of(i)) / measured.d(i);
        ++sums.cells;
        sums.offset.add(offset);
        sums.max = std::max(sums.max, offset);
      });
  std::vector<std::int64_t> counts{own.cells, own.uncrossed};
  comm.allreduce_sum(counts);
  const double offset = comm.allreduce_sum(own.offset).value();
  return {counts[0] > 0 ? offset / static_cast<double>(counts[0]) : 0, comm.allreduce_max(own.max),
          counts[1]};
}

}  // namespace pnpbs
