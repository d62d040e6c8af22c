// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/plane/hull_star.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "predicates/plane.hpp"

namespace pnpbs {

// The area is computed from the shortest side, whose ends have the most accurate difference, and
// rounded down. If it cannot be distinguished from 0, the diameter is infinite.
double circle_diameter(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
  const double ab = squared_distance<2>(a, b), bc = squared_distance<2>(b, c),
               ca = squared_distance<2>(c, a);
  const Point<2>& from = ab <= bc && ab <= ca ? a : bc <= ca ? b : c;
  const Point<2>& to = ab <= bc && ab <= ca ? b : bc <= ca ? c : a;
  const Point<2>& top = ab <= bc && ab <= ca ? c : bc <= ca ? a : b;
  const double left = (to[0] - from[0]) * (top[1] - from[1]);
  const double right = (to[1] - from[1]) * (top[0] - from[0]);
  const double rounding = 4 * std::numeric_limits<double>::epsilon();
  const double twice_area =
      std::fabs(left - right) - rounding * (std::fabs(left) + std::fabs(right));
  if (!(twice_area > 0)) return std::numeric_limits<double>::infinity();
  return std::sqrt(ab) * std::sqrt(bc) * std::sqrt(ca) / twice_area;
}

namespace {

// Returns 0 for directions from that of `first` to 180 degrees on, and 1 for the others.
int half(const StarPoint& centre, const StarPoint& first, const StarPoint& p) {
  const int turn = orientation(centre.position, first.position, p.position);
  if (turn != 0) return turn > 0 ? 0 : 1;
  const double along =
      (p.position[0] - centre.position[0]) * (first.position[0] - centre.position[0]) +
      (p.position[1] - centre.position[1]) * (first.position[1] - centre.position[1]);
  return along > 0 ? 0 : 1;
}

// Sorts counter-clockwise from around[0]. Of two points in one direction, the nearer one comes
// first. An insertion sort is used because the points are few and nearly sorted by bucket.
void sort_by_angle(const StarPoint& centre, std::vector<StarPoint>& around,
                   std::vector<char>& halves) {
  halves.resize(around.size());
  for (std::size_t k = 1; k < around.size(); ++k) {
    const StarPoint p = around[k];
    const char half_p = static_cast<char>(half(centre, around[0], p));
    std::size_t at = k;
    for (; at > 1; --at) {
      const StarPoint& q = around[at - 1];
      if (half_p > halves[at - 1]) break;
      if (half_p == halves[at - 1]) {
        const int turn = orientation(centre.position, q.position, p.position);
        if (turn > 0) break;
        if (turn == 0 && squared_distance<2>(centre.position, q.position) <=
                             squared_distance<2>(centre.position, p.position))
          break;
      }
      around[at] = q;
      halves[at] = halves[at - 1];
    }
    around[at] = p;
    halves[at] = half_p;
  }
}

// Returns whether `middle` belongs to the star between its neighbours `left` and `right`.
bool belongs(const StarPoint& centre, const StarPoint& left, const StarPoint& middle,
             const StarPoint& right) {
  if (orientation(centre.position, left.position, middle.position) == 0) return false;
  if (orientation(centre.position, left.position, right.position) <= 0) return true;
  return in_circle_perturbed(centre.position, left.position, right.position, middle.position,
                             centre.id, left.id, right.id, middle.id) > 0;
}

// Runs a Graham scan over points sorted by angle, from the first, which is in the star, to `last`.
// For a whole star, `last` is again the first.
void keep_star(const StarPoint& centre, const StarPoint& last, std::vector<StarPoint>& around) {
  const std::size_t n = around.size();
  std::size_t top = 0;
  for (std::size_t k = 1; k <= n; ++k) {
    const StarPoint p = k < n ? around[k] : last;
    while (top >= 1 && !belongs(centre, around[top - 1], around[top], p)) --top;
    if (k < n) around[++top] = p;
  }
  around.resize(top + 1);
}

// Returns false if `around` is empty or its nearest point coincides with the centre.
bool put_nearest_first(const StarPoint& centre, std::vector<StarPoint>& around) {
  std::size_t nearest = 0;
  double min = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < around.size(); ++k) {
    const double gap = squared_distance<2>(centre.position, around[k].position);
    if (gap < min || (gap == min && around[k].id < around[nearest].id)) {
      min = gap;
      nearest = k;
    }
  }
  if (around.empty() || min == 0) return false;
  std::swap(around[0], around[nearest]);
  return true;
}

void sort_by_angle(const StarPoint& centre, std::vector<StarPoint>& around) {
  static thread_local std::vector<char> halves;
  sort_by_angle(centre, around, halves);
}

}  // namespace

bool hull_star(const StarPoint& centre, double reach, std::vector<StarPoint>& around) {
  if (around.size() < 3 || !put_nearest_first(centre, around)) return false;
  sort_by_angle(centre, around);
  keep_star(centre, around[0], around);  // The nearest neighbour is always in the star.
  if (around.size() < 3) return false;
  for (std::size_t k = 0; k < around.size(); ++k) {
    const StarPoint &a = around[k], &b = around[(k + 1) % around.size()];
    if (orientation(centre.position, a.position, b.position) <= 0) return false;
    if (circle_diameter(centre.position, a.position, b.position) > reach) return false;
  }
  return true;
}

bool sector_star(const StarPoint& centre, std::int32_t first, std::int32_t last,
                 std::vector<StarPoint>& around) {
  const auto is = [](std::int32_t node) {
    return [node](const StarPoint& p) { return p.node == node; };
  };
  if (first < 0) {
    if (!put_nearest_first(centre, around)) return false;
    first = last = around[0].node;
  }
  const auto begin = std::find_if(around.begin(), around.end(), is(first));
  if (begin == around.end()) return false;
  std::swap(*begin, around[0]);
  sort_by_angle(centre, around);
  const auto end = std::find_if(around.begin(), around.end(), is(last));
  if (end == around.end()) return false;
  const StarPoint behind = *end;
  if (last != first) around.erase(end, around.end());
  keep_star(centre, behind, around);
  around.push_back(behind);
  for (std::size_t k = 0; k + 1 < around.size(); ++k)
    if (orientation(centre.position, around[k].position, around[k + 1].position) <= 0) return false;
  return true;
}

double needed_reach(const Point<2>& centre, const Point<2>& a, const Point<2>& b,
                    const FixedSides& fixed) {
  const auto angle_is_acute = [](const Point<2>& at, const Point<2>& u, const Point<2>& w) {
    return (u[0] - at[0]) * (w[0] - at[0]) + (u[1] - at[1]) * (w[1] - at[1]) > 0;
  };
  const double diameter = circle_diameter(centre, a, b);
  const bool acute_centre = angle_is_acute(centre, a, b), acute_a = angle_is_acute(a, b, centre),
             acute_b = angle_is_acute(b, centre, a);
  double need = std::max(distance<2>(centre, a), distance<2>(centre, b));
  if (!fixed.ab && (!acute_centre || (acute_a && acute_b))) need = std::max(need, diameter);
  if (!fixed.to_a && !acute_b) need = std::max(need, diameter);
  if (!fixed.to_b && !acute_a) need = std::max(need, diameter);
  return need;
}

}  // namespace pnpbs
