// SPDX-License-Identifier: BSD-3-Clause
// The nodes that a level hands on to a finer one: its own, and new ones between them.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "level/level.hpp"

namespace pnpbs {

namespace {

// Into how many pieces of length d a length is cut; one that is long by 1.4 is halved.
int pieces_of(double length, double d) {
  constexpr double kMost = 1e9;
  return static_cast<int>(std::min(length / d + 0.6, kMost));
}

// Calls visit(place) for the new nodes on the edge from x to y, cut into equal pieces: so many
// where it is long enough.
template <class Visit>
void cut_edge(const Point<2>& x, const Point<2>& y, double d, int most, const Visit& visit) {
  const int pieces = std::min(most, pieces_of(distance<2>(x, y), d));
  for (int k = 1; k < pieces; ++k) {
    const double a = static_cast<double>(k) / pieces;
    visit(Point<2>{x[0] + a * (y[0] - x[0]), x[1] + a * (y[1] - x[1])});
  }
}

// The same for those within a triangle whose edges are cut into three pieces or more.
template <class Visit>
void fill_triangle(const std::array<Point<2>, 3>& x, double d, int most, const Visit& visit) {
  const double around = distance<2>(x[0], x[1]) + distance<2>(x[1], x[2]) + distance<2>(x[2], x[0]);
  const int pieces = std::min(most, pieces_of(around / 3, d));
  for (int a = 1; a < pieces - 1; ++a)
    for (int b = 1; b < pieces - a; ++b) {
      Point<2> y;
      for (int k = 0; k < 2; ++k)
        y[k] = x[0][k] + (a * (x[1][k] - x[0][k]) + b * (x[2][k] - x[0][k])) / pieces;
      visit(y);
    }
}

}  // namespace

// Calls visit(place) for the new nodes of an owned node, where the spacing will be d. Edges and
// triangles are their node's with the least id.
template <class Visit>
void Level::for_new_nodes(std::int64_t i, double d, const Visit& visit) const {
  // By the spacings, not by lengths: then nearly every node keeps its number of neighbours.
  const int pieces = pieces_of(spacing_asked_at(i), d);
  if (pieces < 2) return;
  const Point<2> x = nodes_.position(i);
  stars_.for_neighbours(i, [&](std::int64_t j, bool) {
    if (nodes_.id(i) < nodes_.id(j) && !on_one_edge(i, j))
      cut_edge(x, nodes_.position(j), d, pieces, visit);
  });
  if (pieces < 3) return;
  stars_.for_triangles(i, [&](std::int64_t j, std::int64_t k) {
    if (nodes_.id(i) < nodes_.id(j) && nodes_.id(i) < nodes_.id(k))
      fill_triangle({x, nodes_.position(j), nodes_.position(k)}, d, pieces, visit);
  });
}

// Counted first, then written, in chunks of nodes: so that all threads can do it, and nothing has
// to grow.
GivenNodes Level::refined(const Spacing<2>& next) {
  constexpr std::int64_t kChunk = 512;
  set_reference_positions();
  exchange(kStarHops);
  make_lists_and_stars(kStarHops, settings_.list_radius, 0);
  const View<double> spacing = spacing_at_owned_nodes(next);
  GivenNodes nodes;
  agreed(*comm_, [&] {
    const std::int64_t chunks = (nodes_.count + kChunk - 1) / kChunk;
    std::vector<std::size_t> begin(static_cast<std::size_t>(chunks) + 1, 0);
    const auto for_owned_in = [&](std::int64_t chunk, const auto& visit) {
      for (std::int64_t i = chunk * kChunk; i < std::min((chunk + 1) * kChunk, nodes_.count); ++i)
        if (nodes_.owned(i)) visit(i);
    };
    for_each("pnpbs::Level::count_refined", chunks, [&](std::int64_t chunk) {
      std::size_t count = 0;
      for_owned_in(chunk, [&](std::int64_t i) {
        ++count;
        for_new_nodes(i, spacing(i), [&](const Point<2>&) { ++count; });
      });
      begin[static_cast<std::size_t>(chunk) + 1] = count;
    });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    nodes.reserve(begin.back() + begin.back() / 64);  // for some from other ranks
    nodes.resize(begin.back());
    for_each("pnpbs::Level::write_refined", chunks, [&](std::int64_t chunk) {
      std::size_t place = begin[static_cast<std::size_t>(chunk)];
      for_owned_in(chunk, [&](std::int64_t i) {
        nodes[place++] = {nodes_.position(i), nodes_.id(i), nodes_.moves(i), -1, nodes_.d(i)};
        for_new_nodes(i, spacing(i), [&](const Point<2>& x) {
          nodes[place++] = {x, -1, true, -1, spacing(i)};
        });
      });
    });
  });
  return nodes;
}

// Are these the ends of a boundary edge?
bool Level::on_one_edge(std::int64_t i, std::int64_t j) const {
  return !nodes_.moves(i) && !nodes_.moves(j) &&
         sectors_.joined(nodes_.boundary_node(i), nodes_.boundary_node(j));
}

}  // namespace pnpbs
