// SPDX-License-Identifier: BSD-3-Clause
#include "stars/sweep.hpp"

#include <algorithm>

#include "forces/schemes.hpp"
#include "stars/triangle_quality.hpp"

namespace pnpbs {

namespace {

Point<2> at(const std::array<View<double>, 2>& x, std::int64_t i) { return {x[0](i), x[1](i)}; }

// Where the sweep would take node i; its own place if it may not move.
Point<2> proposed_place(const Nodes<2>& nodes, const DelaunayStars& stars,
                        const NearEdges& near_edges, const DomainMap& map, const SweepRule& rule,
                        std::int64_t i) {
  const Point<2> x = nodes.position(i);
  if (!nodes.moves(i) || stars.size(i) < 3) return x;
  Point<2> mean{};
  bool closed = true;
  stars.for_neighbours(i, [&](std::int64_t j, bool triangle) {
    for (int k = 0; k < 2; ++k) mean[k] += nodes.x[k](j);
    closed = closed && triangle;
  });
  if (!closed) return x;
  std::array<double, 2> move;
  for (int k = 0; k < 2; ++k) move[k] = rule.weight * (mean[k] / stars.size(i) - x[k]);
  clamp_move<2>(move, rule.most * nodes.d(i));
  const Point<2> y{x[0] + move[0], x[1] + move[1]};
  if (!near_edges.any(i)) return y;
  const KeptOff kept = keep_off(map, near_edges.edges_of(i), x, y, nodes.d(i));
  return kept.room ? kept.position : x;
}

// Worst quality of triangle (i, j, k) when i has moved and the others have or have not.
double worst_if_moved(const Nodes<2>& nodes, const std::array<View<double>, 2>& proposed,
                      std::int64_t i, std::int64_t j, std::int64_t k) {
  const Point<2> a = at(proposed, i);
  const Point<2> b[2] = {nodes.position(j), at(proposed, j)};
  const Point<2> c[2] = {nodes.position(k), at(proposed, k)};
  return std::min({triangle_quality(a, b[0], c[0]), triangle_quality(a, b[0], c[1]),
                   triangle_quality(a, b[1], c[0]), triangle_quality(a, b[1], c[1])});
}

// May node i go to its proposed place, whatever its neighbours do? Then no order, and no rounds,
// come into the decision.
bool may_move(const Nodes<2>& nodes, const DelaunayStars& stars, const SweepRule& rule,
              const std::array<View<double>, 2>& proposed, std::int64_t i) {
  bool allowed = true;
  stars.for_triangles(i, [&](std::int64_t j, std::int64_t k) {
    if (!allowed) return;
    const double after = worst_if_moved(nodes, proposed, i, j, k);
    if (after >= rule.bad_below) return;
    allowed = after >= triangle_quality(nodes.position(i), nodes.position(j), nodes.position(k));
  });
  return allowed;
}

}  // namespace

void sweep(const Nodes<2>& nodes, const DelaunayStars& stars, const NearEdges& near_edges,
           const DomainMap& map, const SweepRule& rule, const std::array<View<double>, 2>& proposed,
           const View<char>& allowed) {
  for_each("pnpbs::sweep::propose", nodes.count, [&](std::int64_t i) {
    const Point<2> y = proposed_place(nodes, stars, near_edges, map, rule, i);
    proposed[0](i) = y[0];
    proposed[1](i) = y[1];
  });
  for_each("pnpbs::sweep::guard", nodes.count, [&](std::int64_t i) {
    allowed(i) = nodes.moves(i) && may_move(nodes, stars, rule, proposed, i);
  });
  for_each("pnpbs::sweep::go", nodes.count, [&](std::int64_t i) {
    if (allowed(i)) nodes.set_position(i, at(proposed, i));
  });
}

}  // namespace pnpbs
