// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/nodal_patch.hpp"

#include <algorithm>

#include "predicates/plane.hpp"

namespace pnpbs {

namespace {

template <std::size_t N>
Box<2> box_around(const std::vector<PatchNode>& nodes, const std::array<std::int32_t, N>& corners) {
  const Point<2>& first = nodes[static_cast<std::size_t>(corners[0])].x;
  Box<2> box{first, first};
  for (const std::int32_t corner : corners) {
    const Point<2>& x = nodes[static_cast<std::size_t>(corner)].x;
    box = joined(box, {x, x});
  }
  return box;
}

template <std::size_t N>
BoxTree<2> tree_of(const std::vector<PatchNode>& nodes,
                   const std::vector<std::array<std::int32_t, N>>& rows) {
  std::vector<Box<2>> boxes;
  boxes.reserve(rows.size());
  for (const auto& row : rows) boxes.push_back(box_around(nodes, row));
  return BoxTree<2>(std::move(boxes));
}

bool holds(const Point<2>& a, const Point<2>& b, const Point<2>& c, const Point<2>& x) {
  const int signs[3] = {orientation(a, b, x), orientation(b, c, x), orientation(c, a, x)};
  const bool left = signs[0] > 0 || signs[1] > 0 || signs[2] > 0;
  const bool right = signs[0] < 0 || signs[1] < 0 || signs[2] < 0;
  return !(left && right);
}

// Twice the area of triangle (x, a, b), with its sign.
double area(const Point<2>& x, const Point<2>& a, const Point<2>& b) {
  return (a[0] - x[0]) * (b[1] - x[1]) - (a[1] - x[1]) * (b[0] - x[0]);
}

}  // namespace

NodalPatch::NodalPatch(Patch patch)
    : patch_(std::move(patch)),
      by_triangle_(tree_of(patch_.nodes, patch_.triangles)),
      by_edge_(tree_of(patch_.nodes, patch_.rim)) {}

// Rounding must not take the value beyond those of the corners.
void NodalPatch::interpolate(const Point<2>& x, PatchAnswer& best) const {
  by_triangle_.for_holding(x, [&](std::int32_t t) {
    const auto& corners = patch_.triangles[static_cast<std::size_t>(t)];
    const PatchNode &a = node(corners[0]), &b = node(corners[1]), &c = node(corners[2]);
    if (!holds(a.x, b.x, c.x, x)) return;
    PatchAnswer answer{0, {a.id, b.id, c.id}, 0};
    if (!(answer < best)) return;
    const double at_a = area(x, b.x, c.x), at_b = area(x, c.x, a.x), at_c = area(x, a.x, b.x);
    const double value = (at_a * a.value + at_b * b.value + at_c * c.value) / (at_a + at_b + at_c);
    const auto [least, most] = std::minmax({a.value, b.value, c.value});
    answer.value = std::clamp(value, least, most);
    best = answer;
  });
}

// The gap is never less than that to the edge's box, so that boxes that are farther than the best
// answer can be passed over without changing it.
void NodalPatch::extend(const Point<2>& x, PatchAnswer& best) const {
  by_edge_.for_near(
      x, [&] { return best.gap; },
      [&](std::int32_t e) {
        const auto& ends = patch_.rim[static_cast<std::size_t>(e)];
        const PatchNode &a = node(ends[0]), &b = node(ends[1]);
        const double along[2] = {b.x[0] - a.x[0], b.x[1] - a.x[1]};
        const double t = std::clamp(((x[0] - a.x[0]) * along[0] + (x[1] - a.x[1]) * along[1]) /
                                        (along[0] * along[0] + along[1] * along[1]),
                                    0.0, 1.0);
        const Point<2> foot{a.x[0] + t * along[0], a.x[1] + t * along[1]};
        const double gap = std::max(squared_distance<2>(x, foot),
                                    squared_gap_to(box_around(patch_.nodes, ends), x));
        const auto [least, most] = std::minmax({a.value, b.value});
        const PatchAnswer answer{
            gap, {a.id, b.id, 0}, std::clamp(a.value + t * (b.value - a.value), least, most)};
        if (answer < best) best = answer;
      });
}

}  // namespace pnpbs
