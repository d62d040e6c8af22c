// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/copies_of_cell.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>

#include "tree/box_tree.hpp"

namespace pnpbs {

namespace {

// Returns the translation of the user's coordinates to a copy of the cell.
Point<2> to_copy(const PeriodicCell<2>& cell, const Image<2>& image, const Point<2>& x) {
  return cell.seen_from({-image[0], -image[1]}, x);
}

CurveSource copy_of(const PeriodicCell<2>& cell, const Image<2>& image, CurveSource source) {
  for (Point<2>& x : source.points) x = to_copy(cell, image, x);
  if (source.evaluate)
    source.evaluate = [cell, image, evaluate = std::move(source.evaluate)](
                          std::int64_t n, const double* t, Point<2>* x) {
      evaluate(n, t, x);
      for (std::int64_t i = 0; i < n; ++i) x[i] = to_copy(cell, image, cell.rounded(x[i]));
    };
  return source;
}

CurveSource boundary_line(const Point<2>& begin, const Point<2>& end, std::int32_t tag) {
  CurveSource line;
  line.kind = CurveSource::Kind::polyline;
  line.role = CurveRole::boundary;
  line.tags = {tag};
  line.points = {begin, end};
  return line;
}

Box<2> box_of(const CurveSource& source) {
  Box<2> box{source.points[0], source.points[0]};
  for (const Point<2>& x : source.points) box = joined(box, {x, x});
  return box;
}

}  // namespace

CopiesOfCell copies_of_cell(const PeriodicCell<2>& cell, const Image<2>& copies,
                            const std::array<std::int32_t, 4>& side_tags,
                            const std::vector<CurveSource>& sources,
                            const std::vector<RegionPoint<2>>& region_points,
                            const std::vector<FixedNode<2>>& fixed_nodes) {
  Box<2> outer = cell.box();
  for (std::size_t k = 0; k < 2; ++k) {
    outer.low[k] -= copies[k] * cell.period(static_cast<int>(k));
    outer.high[k] += copies[k] * cell.period(static_cast<int>(k));
  }
  CopiesOfCell all;
  // The sides of the cell that bound the domain are lines of one period.
  std::vector<CurveSource> of_cell = sources;
  for (CurveSource& source : of_cell)
    for (Point<2>& x : source.points) x = cell.rounded(x);
  const Box<2>& box = cell.box();
  for (std::size_t k = 0; k < 2; ++k) {
    if (cell.periodic(static_cast<int>(k))) continue;
    for (std::size_t high = 0; high < 2; ++high) {
      Point<2> begin = box.low, end = box.high;
      begin[k] = end[k] = high != 0 ? box.high[k] : box.low[k];
      of_cell.push_back(boundary_line(begin, end, side_tags[2 * k + high]));
    }
  }
  const auto inside = [&](const Box<2>& part) {
    for (std::size_t k = 0; k < 2; ++k)
      if (cell.periodic(static_cast<int>(k)) &&
          (part.low[k] < outer.low[k] || part.high[k] > outer.high[k]))
        return false;
    return true;
  };
  for (std::int32_t y = -copies[1]; y <= copies[1]; ++y)
    for (std::int32_t x = -copies[0]; x <= copies[0]; ++x) {
      const Image<2> image{x, y};
      for (std::size_t s = 0; s < of_cell.size(); ++s) {
        CurveSource copy = copy_of(cell, image, of_cell[s]);
        if (s < sources.size() && !inside(box_of(copy))) continue;
        all.sources.push_back(std::move(copy));
        all.in_cell.push_back(image == Image<2>{});
      }
      // The curves around a point in an outermost copy may be left out.
      const bool outermost = (copies[0] > 0 && std::abs(x) == copies[0]) ||
                             (copies[1] > 0 && std::abs(y) == copies[1]);
      for (RegionPoint<2> point : region_points) {
        if (outermost) break;
        point.point = to_copy(cell, image, cell.in_cell(cell.rounded(point.point)));
        all.region_points.push_back(std::move(point));
      }
      for (FixedNode<2> node : fixed_nodes) {
        node.position = to_copy(cell, image, cell.in_cell(cell.rounded(node.position)));
        all.fixed_nodes.push_back(std::move(node));
      }
    }
  // The boundary around the copies
  const Point<2>&a = outer.low, &b = outer.high;
  for (std::size_t k = 0; k < 2; ++k) {
    if (!cell.periodic(static_cast<int>(k))) continue;
    for (const double at : {a[k], b[k]}) {
      Point<2> begin = a, end = b;
      begin[k] = end[k] = at;
      all.sources.push_back(boundary_line(begin, end, 1));
      all.in_cell.push_back(0);
    }
  }
  return all;
}

// By Green's theorem, as the integral of one coordinate along the curves. Periodic sides of the
// cell do not contribute if it is the coordinate across the period.
double area_of_cell(const PeriodicCell<2>& cell, const std::vector<BoundaryCurve>& curves,
                    const std::vector<char>& in_cell) {
  const Box<2>& box = cell.box();
  const bool all_periodic = cell.periodic(0) && cell.periodic(1);
  double area = all_periodic ? cell.period(0) * cell.period(1) : 0;
  const auto segment = [&](const Point<2>& p, const Point<2>& q) {
    return cell.periodic(0) ? -(0.5 * (p[1] + q[1]) - box.low[1]) * (q[0] - p[0])
                            : (0.5 * (p[0] + q[0]) - box.low[0]) * (q[1] - p[1]);
  };
  for (const BoundaryCurve& curve : curves) {
    if (!curve.bounds() || !in_cell[static_cast<std::size_t>(curve.source)]) continue;
    const double sign = curve.left_inside ? 1 : -1;
    for (std::size_t i = 0; i + 1 < curve.points.size(); ++i) {
      const Point<2>&p = curve.points[i], &q = curve.points[i + 1];
      area += sign * segment(p, q);
      if (!curve.evaluate) continue;
      const double t = 0.5 * curve.parameters[i] + 0.5 * curve.parameters[i + 1];
      Point<2> middle;
      curve.evaluate(1, &t, &middle);
      // A parabola through the middle is apart from the chord by 4/3 of this triangle.
      area += sign * 4 / 3 * 0.5 *
              ((middle[0] - p[0]) * (q[1] - p[1]) - (middle[1] - p[1]) * (q[0] - p[0]));
    }
  }
  return area;
}

}  // namespace pnpbs
