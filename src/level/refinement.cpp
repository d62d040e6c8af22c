// SPDX-License-Identifier: BSD-3-Clause
#include "level/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "level/exchange.hpp"
#include "level/lists_and_stars.hpp"
#include "level/node_spacing.hpp"
#include "level/reach.hpp"

namespace pnpbs {

namespace {

// Into how many pieces of length d a length is cut; one that is long by 1.4 is halved.
int pieces_of(double length, double d) {
  constexpr double kMax = 1e9;
  return static_cast<int>(std::min(length / d + 0.6, kMax));
}

// Calls visit(place) for the new nodes on the edge from x to y, cut into equal pieces: so many
// where it is long enough.
template <class Visit>
void cut_edge(const Point<2>& x, const Point<2>& y, double d, int max, const Visit& visit) {
  const int pieces = std::min(max, pieces_of(distance<2>(x, y), d));
  for (int k = 1; k < pieces; ++k) {
    const double a = static_cast<double>(k) / pieces;
    visit(Point<2>{x[0] + a * (y[0] - x[0]), x[1] + a * (y[1] - x[1])});
  }
}

// The same for those within a triangle whose edges are cut into three pieces or more.
template <class Visit>
void fill_triangle(const std::array<Point<2>, 3>& x, double d, int max, const Visit& visit) {
  const double around = distance<2>(x[0], x[1]) + distance<2>(x[1], x[2]) + distance<2>(x[2], x[0]);
  const int pieces = std::min(max, pieces_of(around / 3, d));
  for (int a = 1; a < pieces - 1; ++a)
    for (int b = 1; b < pieces - a; ++b) {
      Point<2> y;
      for (int k = 0; k < 2; ++k)
        y[k] = x[0][k] + (a * (x[1][k] - x[0][k]) + b * (x[2][k] - x[0][k])) / pieces;
      visit(y);
    }
}

// Calls visit(place) for the new nodes of an owned node, where the spacing will be d. Edges and
// triangles are their node's with the least id.
template <class Visit>
void for_new_nodes(const Level& level, std::int64_t i, double d, const Visit& visit) {
  const Nodes<2>& nodes = level.nodes;
  // By the spacings, not by lengths: then nearly every node keeps its number of neighbours.
  const int pieces = pieces_of(level.ground.spacing_at(nodes, i), d);
  if (pieces < 2) return;
  const Point<2> x = nodes.position(i);
  level.stars.for_neighbours(i, [&](std::int64_t j) {
    if (nodes.id(i) < nodes.id(j) && !level.ground.on_one_edge(nodes, i, j))
      cut_edge(x, nodes.position(j), d, pieces, visit);
  });
  if (pieces < 3) return;
  level.stars.for_simplices(i, [&](const DelaunayStars::Corners& others) {
    const std::int64_t j = others[0], k = others[1];
    if (nodes.id(i) < nodes.id(j) && nodes.id(i) < nodes.id(k))
      fill_triangle({x, nodes.position(j), nodes.position(k)}, d, pieces, visit);
  });
}

}  // namespace

// Counted first, then written, in chunks of nodes: so that all threads can do it, and nothing has
// to grow.
GivenNodes refined(Level& level, const Spacing<2>& next) {
  constexpr std::int64_t kChunk = 512;
  level.nodes.set_reference_positions();
  exchange(level, kStarHops);
  make_lists_and_stars(level, kStarHops, level.settings.list_radius, 0);
  const View<double> spacing = spacing_at_owned_nodes(level, next);
  const Nodes<2>& nodes = level.nodes;
  GivenNodes refined;
  agreed(*level.comm, [&] {
    const std::int64_t chunks = (nodes.count + kChunk - 1) / kChunk;
    std::vector<std::size_t> begin(static_cast<std::size_t>(chunks) + 1, 0);
    const auto for_owned_in = [&](std::int64_t chunk, const auto& visit) {
      for (std::int64_t i = chunk * kChunk; i < std::min((chunk + 1) * kChunk, nodes.count); ++i)
        if (nodes.owned(i)) visit(i);
    };
    for_each("pnpbs::count_refined", chunks, [&](std::int64_t chunk) {
      std::size_t count = 0;
      for_owned_in(chunk, [&](std::int64_t i) {
        ++count;
        for_new_nodes(level, i, spacing(i), [&](const Point<2>&) { ++count; });
      });
      begin[static_cast<std::size_t>(chunk) + 1] = count;
    });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    refined.reserve(begin.back() + begin.back() / 64);  // for some from other ranks
    refined.resize(begin.back());
    for_each("pnpbs::write_refined", chunks, [&](std::int64_t chunk) {
      std::size_t place = begin[static_cast<std::size_t>(chunk)];
      for_owned_in(chunk, [&](std::int64_t i) {
        refined[place++] = {nodes.position(i), nodes.id(i), nodes.moves(i), -1, nodes.d(i)};
        for_new_nodes(level, i, spacing(i), [&](const Point<2>& x) {
          refined[place++] = {x, -1, true, -1, spacing(i)};
        });
      });
    });
  });
  return refined;
}

}  // namespace pnpbs
