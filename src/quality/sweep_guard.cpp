// SPDX-License-Identifier: BSD-3-Clause
#include "quality/sweep_guard.hpp"

#include <algorithm>

#include "dynamics/bubble_force.hpp"

namespace pnpbs {

namespace {

// Returns the smallest quality of triangle (i, j, k) with i at its proposed position and each of
// the others at its old or proposed position.
double worst_if_moved(const Nodes<2>& nodes, const Field<2>& proposed, std::int64_t i,
                      std::int64_t j, std::int64_t k) {
  const Point<2> a = point_at<2>(proposed, i);
  const Point<2> b[2] = {nodes.position(j), point_at<2>(proposed, j)};
  const Point<2> c[2] = {nodes.position(k), point_at<2>(proposed, k)};
  return std::min({triangle_quality(a, b[0], c[0]), triangle_quality(a, b[0], c[1]),
                   triangle_quality(a, b[1], c[0]), triangle_quality(a, b[1], c[1])});
}

// Returns whether node i may move to its proposed position, no matter which of its neighbours move.
// The decision therefore needs no order of the nodes and no rounds.
bool may_move(const Nodes<2>& nodes, const DelaunayStars& stars, double bad_below,
              const Field<2>& proposed, std::int64_t i) {
  bool allowed = true;
  stars.for_simplices(i, [&](const DelaunayStars::Corners& others) {
    if (!allowed) return;
    const std::int64_t j = others[0], k = others[1];
    const double after = worst_if_moved(nodes, proposed, i, j, k);
    if (after >= bad_below) return;
    allowed = after >= triangle_quality(nodes.position(i), nodes.position(j), nodes.position(k));
  });
  return allowed;
}

// A neighbour relative to the proposed position of a node, in units of the node's d. Index 0 is the
// neighbour's old position and index 1 its proposed one; `square` is the squared distance.
struct Corner {
  double x0, y0, square0, x1, y1, square1;
};

// The corners of all lanes of a block, as a structure of arrays.
struct Corners {
  double x0[kLanes], y0[kLanes], square0[kLanes], x1[kLanes], y1[kLanes], square1[kLanes];

  Corner get(int lane) const {
    return {x0[lane], y0[lane], square0[lane], x1[lane], y1[lane], square1[lane]};
  }
  void set(int lane, const Corner& c) {
    x0[lane] = c.x0;
    y0[lane] = c.y0;
    square0[lane] = c.square0;
    x1[lane] = c.x1;
    y1[lane] = c.y1;
    square1[lane] = c.square1;
  }
};

// The proposed positions of the nodes of a block, and the inverses of their spacings.
struct Viewpoints {
  double x[kLanes], y[kLanes], scale[kLanes];

  Viewpoints(const Positions<2>& proposed, const double* d, const std::int64_t (&self)[kLanes]) {
    for (int lane = 0; lane < kLanes; ++lane) {
      x[lane] = proposed[0][self[lane]];
      y[lane] = proposed[1][self[lane]];
      scale[lane] = 1 / d[self[lane]];
    }
  }

  // Returns node j relative to the node in this lane.
  Corner see(const Positions<2>& old, const Positions<2>& proposed, std::int32_t j,
             int lane) const {
    Corner c;
    c.x0 = scale[lane] * (old[0][j] - x[lane]);
    c.y0 = scale[lane] * (old[1][j] - y[lane]);
    c.x1 = scale[lane] * (proposed[0][j] - x[lane]);
    c.y1 = scale[lane] * (proposed[1][j] - y[lane]);
    c.square0 = c.x0 * c.x0 + c.y0 * c.y0;
    c.square1 = c.x1 * c.x1 + c.y1 * c.y1;
    return c;
  }
};

inline double lesser(double a, double b) { return a < b ? a : b; }
inline double larger(double a, double b) { return a > b ? a : b; }
inline double cross(double bx, double by, double cx, double cy) { return bx * cy - by * cx; }
inline double squared(double x, double y) { return x * x + y * y; }

// Returns 1 if the triangle of a node and these two corners certainly meets the bound, no matter
// which of the two corners move.
inline std::int32_t surely_met(const QualityBound& bound, const Corner& b, const Corner& c) {
  const double twice_area =
      lesser(lesser(cross(b.x0, b.y0, c.x0, c.y0), cross(b.x0, b.y0, c.x1, c.y1)),
             lesser(cross(b.x1, b.y1, c.x0, c.y0), cross(b.x1, b.y1, c.x1, c.y1)));
  const double third =
      larger(larger(squared(c.x0 - b.x0, c.y0 - b.y0), squared(c.x1 - b.x0, c.y1 - b.y0)),
             larger(squared(c.x0 - b.x1, c.y0 - b.y1), squared(c.x1 - b.x1, c.y1 - b.y1)));
  return bound.surely_met(twice_area, larger(b.square0, b.square1), larger(c.square0, c.square1),
                          third);
}

// Sets sure[lane] to 1 if none of the node's triangles can become bad, so that the node may
// certainly move. Otherwise sets it to 0, which leaves the decision open. Only for blocks with
// entries.
void find_surely_allowed(const Nodes<2>& nodes, const DelaunayStars::Block& block,
                         const QualityBound& bound, const Field<2>& proposed, std::int64_t b,
                         std::int32_t (&sure)[kLanes]) {
  const Positions<2> old = positions_of<2>(nodes.x), next = positions_of<2>(proposed);
  std::int64_t self[kLanes];
  block_nodes(b, nodes.count, self);
  const Viewpoints from(next, nodes.d.data(), self);
  Corners last;
  for (int lane = 0; lane < kLanes; ++lane) {
    last.set(lane, from.see(old, next, block.entries[lane].value(), lane));
    sure[lane] = 1;
  }
  for (std::int32_t k = 1; k <= block.length; ++k) {
    const DelaunayStars::Entry* const entries = block.entries + (k < block.length ? k : 0) * kLanes;
#pragma omp simd
    for (int lane = 0; lane < kLanes; ++lane) {
      const Corner corner = from.see(old, next, entries[lane].value(), lane);
      const std::int32_t beyond = k > block.sizes[lane].value() ? 1 : 0;
      sure[lane] &= surely_met(bound, last.get(lane), corner) | beyond;
      last.set(lane, corner);
    }
  }
}

}  // namespace

void guard_block(const Nodes<2>& nodes, const DelaunayStars& stars, double bad_below,
                 const QualityBound& bound, const Field<2>& proposed, View<char>& allowed,
                 std::int64_t b) {
  const DelaunayStars::Block block = stars.block(b);
  std::int32_t sure[kLanes]{};
  if (block.length > 0) find_surely_allowed(nodes, block, bound, proposed, b, sure);
  const std::int64_t first = b * kLanes;
  const int lanes = static_cast<int>(std::min<std::int64_t>(kLanes, nodes.count - first));
  for (int lane = 0; lane < lanes; ++lane) {
    const std::int64_t i = first + lane;
    // The proposed position of all other nodes is their old one.
    const bool goes = nodes.moves(i) && block.sizes[lane].flag();
    allowed(i) = goes && (sure[lane] || may_move(nodes, stars, bad_below, proposed, i));
  }
}

std::vector<std::int32_t> nodes_with_doubtful_triangles(const Nodes<2>& nodes,
                                                        const DelaunayStars& stars,
                                                        double quality) {
  const QualityBound bound(quality);
  std::vector<char> doubtful(static_cast<std::size_t>(nodes.count));
  for_each("pnpbs::nodes_with_doubtful_triangles", stars.block_count(), [&](std::int64_t b) {
    const DelaunayStars::Block block = stars.block(b);
    if (block.length == 0) return;
    std::int32_t sure[kLanes];
    find_surely_allowed(nodes, block, bound, nodes.x, b, sure);
    for (std::int64_t i = b * kLanes; i < std::min((b + 1) * kLanes, nodes.count); ++i)
      doubtful[static_cast<std::size_t>(i)] = sure[i % kLanes] == 0;
  });
  std::vector<std::int32_t> found;
  for (std::int64_t i = 0; i < nodes.count; ++i)
    if (doubtful[static_cast<std::size_t>(i)] != 0) found.push_back(static_cast<std::int32_t>(i));
  return found;
}

}  // namespace pnpbs
