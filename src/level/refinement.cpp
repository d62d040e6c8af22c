// SPDX-License-Identifier: BSD-3-Clause
#include "level/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "level/exchange.hpp"
#include "level/kept_node.hpp"
#include "level/lists_and_stars.hpp"
#include "level/node_spacing.hpp"
#include "level/reach.hpp"
#include "level/thinning.hpp"
#include "level/volume/surface_level.hpp"
#include "method/constants.hpp"

namespace pnpbs {

namespace {

// Returns the number of pieces of length d for an edge. The plane halves an edge from 1.4 d on.
// Space does so from 1.25 d on, because surplus nodes are thinned there.
template <int Dim>
int pieces_of(double length, double d) {
  constexpr double kMax = 1e9,
                   kRoundUp = Dim == 2 ? method::kRoundUpInPlane : method::kRoundUpInSpace;
  return static_cast<int>(std::min(length / d + kRoundUp, kMax));
}

// Calls visit(position) for the new nodes on the edge from x to y. The edge is cut into equal
// pieces, at most `max`.
template <int Dim, class Visit>
void cut_edge(const Point<Dim>& x, const Point<Dim>& y, double d, int max, const Visit& visit) {
  const int pieces = std::min(max, pieces_of<Dim>(distance<Dim>(x, y), d));
  for (int k = 1; k < pieces; ++k) {
    const double a = static_cast<double>(k) / pieces;
    Point<Dim> place;
    for (int c = 0; c < Dim; ++c) place[c] = x[c] + a * (y[c] - x[c]);
    visit(place);
  }
}

// Calls visit(position) for the new nodes inside a triangle whose edges are cut into three pieces
// or more.
template <class Visit>
void fill_triangle(const std::array<Point<2>, 3>& x, double d, int max, const Visit& visit) {
  const double around = distance<2>(x[0], x[1]) + distance<2>(x[1], x[2]) + distance<2>(x[2], x[0]);
  const int pieces = std::min(max, pieces_of<2>(around / 3, d));
  for (int a = 1; a < pieces - 1; ++a)
    for (int b = 1; b < pieces - a; ++b) {
      Point<2> y;
      for (int k = 0; k < 2; ++k)
        y[k] = x[0][k] + (a * (x[1][k] - x[0][k]) + b * (x[2][k] - x[0][k])) / pieces;
      visit(y);
    }
}

// Visits the new nodes in the triangles in which node i has the smallest id.
template <class Visit>
void for_new_nodes_in_triangles(const Level<2>& level, std::int64_t i, double d, int pieces,
                                const Visit& visit) {
  const Nodes<2>& nodes = level.nodes;
  level.stars.for_simplices(i, [&](const DelaunayStars::Corners& others) {
    const std::int64_t j = others[0], k = others[1];
    if (nodes.id(i) < nodes.id(j) && nodes.id(i) < nodes.id(k))
      fill_triangle({nodes.position(i), nodes.position(j), nodes.position(k)}, d, pieces, visit);
  });
}

// Returns whether both nodes lie on one boundary edge of the plane, which is discretized again
// instead of refined. The surface nodes of a volume are refined with the others; nodes too close to
// them find no room later.
bool on_one_edge(const LevelGeometry<2>& geometry, const Nodes<2>& nodes, std::int64_t i,
                 std::int64_t j) {
  return geometry.on_one_edge(nodes, i, j);
}
bool on_one_edge(const LevelGeometry<3>&, const Nodes<3>&, std::int64_t, std::int64_t) {
  return false;
}

// Calls visit(position) for the new nodes around owned node i, for the spacing d of the next level.
// An edge belongs to its node with the smaller id.
template <int Dim, class Visit>
void for_new_nodes(const Level<Dim>& level, std::int64_t i, double d, const Visit& visit) {
  const Nodes<Dim>& nodes = level.nodes;
  // The ratio of the spacings limits the pieces. Nearly every node then keeps its number of
  // neighbours, whatever the lengths are.
  const int pieces = pieces_of<Dim>(level.geometry.spacing_at(nodes, i), d);
  if (pieces < 2 || level.geometry.kind() == GeometryKind::surface) return;
  const Point<Dim> x = nodes.position(i);
  level.stars.for_neighbours(i, [&](std::int64_t j) {
    if (nodes.id(i) < nodes.id(j) && !on_one_edge(level.geometry, nodes, i, j))
      cut_edge<Dim>(x, nodes.position(j), d, pieces, visit);
  });
  if constexpr (Dim == 2)
    if (pieces >= 3) for_new_nodes_in_triangles(level, i, d, pieces, visit);
}

// Makes nodes of the closing patch inner nodes, in case the patch of the next level does not
// contain them.
void leave_patch(const Level<2>& level, IncomingNode<2>& node) {
  node.inner = node.inner || level.geometry.domain().is_in_patch(node.position);
}
void leave_patch(const Level<3>&, IncomingNode<3>&) {}

// Exempts a node from thinning unless d has grown at it. Thinning uses one value of d per leaf, and
// d may vary more within a leaf than it has grown.
template <int Dim>
void exempt_from_thinning(IncomingNode<Dim>& node, double d) {
  if (d <= method::kThinnedAbove * node.d) node.d = 0;
}

void append_surface_midpoints(const Level<2>&, const View<double>&, IncomingNodes<2>&) {}

IncomingNode<2> new_node(const Point<2>& x, double, double) { return {x, -1}; }
// Returns a new node where the spacing was `before` and will be d. Cutting edges in space may
// create more nodes than d requires, so the node records the spacing that it counts as placed for.
IncomingNode<3> new_node(const Point<3>& x, double before, double d) {
  IncomingNode<3> node{x, -1};
  const double cuts = pieces_of<3>(before, d) - 1;
  node.d = placed_for<3>(before, d, 0.5 * Lattice<3>::kNeighbours * cuts);
  return node;
}

}  // namespace

// Counts the nodes first and then writes them, in chunks, so that all threads take part and no
// array grows.
template <int Dim>
IncomingNodes<Dim> refined(Level<Dim>& level, const Spacing<Dim>& next) {
  constexpr std::int64_t kChunk = 512;
  level.nodes.set_reference_positions();
  exchange(level, kStarHops);
  if (level.geometry.kind() == GeometryKind::surface)
    collective_try(*level.comm, [&] { rebuild_lists(level, level.settings.list_radius); });
  else
    make_lists_and_stars(level, kStarHops, level.settings.list_radius, {});
  const View<double> spacing = spacing_at_owned_nodes(level, next);
  const Nodes<Dim>& nodes = level.nodes;
  IncomingNodes<Dim> refined;
  collective_try(*level.comm, [&] {
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
        for_new_nodes(level, i, spacing(i), [&](const Point<Dim>&) { ++count; });
      });
      begin[static_cast<std::size_t>(chunk) + 1] = count;
    });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    refined.reserve(begin.back() + begin.back() / 64);  // for some from other ranks
    refined.resize(begin.back());
    for_each("pnpbs::write_refined", chunks, [&](std::int64_t chunk) {
      std::size_t place = begin[static_cast<std::size_t>(chunk)];
      for_owned_in(chunk, [&](std::int64_t i) {
        const double before = level.geometry.spacing_at(nodes, i);
        const auto put = [&](IncomingNode<Dim> node) {
          exempt_from_thinning(node, spacing(i));
          refined[place++] = node;
        };
        IncomingNode<Dim> kept = kept_node(nodes, i);
        leave_patch(level, kept);
        put(kept);
        for_new_nodes(level, i, spacing(i),
                      [&](const Point<Dim>& x) { put(new_node(x, before, spacing(i))); });
      });
    });
    append_surface_midpoints(level, spacing, refined);
  });
  return refined;
}

template IncomingNodes<2> refined(Level<2>&, const Spacing<2>&);
template IncomingNodes<3> refined(Level<3>&, const Spacing<3>&);

}  // namespace pnpbs
