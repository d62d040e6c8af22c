// SPDX-License-Identifier: BSD-3-Clause
#include "stars/sweep.hpp"

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

bool spoils_a_triangle(const Nodes<2>& nodes, const DelaunayStars& stars, const SweepRule& rule,
                       const std::array<View<double>, 2>& next, std::int64_t i) {
  bool spoiled = false;
  stars.for_triangles(i, [&](std::int64_t j, std::int64_t k) {
    if (spoiled) return;
    const double after = triangle_quality(at(next, i), at(next, j), at(next, k));
    if (after >= rule.bad_below) return;
    spoiled = after <
              triangle_quality(nodes.position(i), nodes.position(j), nodes.position(k));
  });
  return spoiled;
}

}  // namespace

void sweep(const Nodes<2>& nodes, const DelaunayStars& stars, const NearEdges& near_edges,
           const DomainMap& map, const SweepRule& rule, const std::array<View<double>, 2>& next,
           const View<char>& moved, const View<char>& back) {
  for_each("pnpbs::sweep::propose", nodes.count, [&](std::int64_t i) {
    const Point<2> x = nodes.position(i);
    const Point<2> y = proposed_place(nodes, stars, near_edges, map, rule, i);
    next[0](i) = y[0];
    next[1](i) = y[1];
    moved(i) = y != x;
  });
  for (;;) {
    const std::uint64_t spoilers =
        sum_of("pnpbs::sweep::guard", nodes.count, [&](std::int64_t i) -> std::uint64_t {
          back(i) = moved(i) && spoils_a_triangle(nodes, stars, rule, next, i);
          return back(i) ? 1 : 0;
        });
    if (spoilers == 0) return;
    for_each("pnpbs::sweep::back", nodes.count, [&](std::int64_t i) {
      if (!back(i)) return;
      moved(i) = 0;
      next[0](i) = nodes.x[0](i);
      next[1](i) = nodes.x[1](i);
    });
  }
}

}  // namespace pnpbs
