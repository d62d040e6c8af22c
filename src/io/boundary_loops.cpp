// SPDX-License-Identifier: BSD-3-Clause
#include "io/boundary_loops.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <unordered_map>
#include <utility>

#include "base/error.hpp"
#include "comm/records.hpp"
#include "geometry/volume/winding_number.hpp"

namespace pnpbs::io {

namespace {

// Positions of boundary nodes by their numbers.
using Places = std::unordered_map<std::int64_t, Point<3>>;

// A node with its position, as ranks exchange it.
struct NodePlace {
  std::int64_t number;
  Point<3> x;
};

// Returns the edges that bound the domain, of all ranks, with the domain on their left, sorted by
// their first node. Collective.
std::vector<LoopEdge> bounding_edges(const NodeSource& nodes, const Communicator& comm) {
  std::vector<LoopEdge> own;
  nodes.for_facets([&](const FacetRows& rows) {
    for (std::size_t f = 0; f < rows.tags.size(); ++f) {
      if (rows.domain[f] == Side::both) continue;
      LoopEdge edge{rows.nodes[2 * f], rows.nodes[2 * f + 1], rows.tags[f]};
      if (rows.domain[f] == Side::right) std::swap(edge.begin, edge.end);
      own.push_back(edge);
    }
  });
  std::vector<LoopEdge> edges = of_all_ranks(comm, own);
  std::ranges::sort(edges);
  return edges;
}

// Returns the positions of all boundary nodes; z is 0 in the plane. Collective.
Places places_of(const std::vector<LoopEdge>& edges, const NodeSource& nodes,
                 const Communicator& comm) {
  Places places;
  for (const LoopEdge& edge : edges) places[edge.begin] = {};
  const auto coordinates = static_cast<std::size_t>(nodes.contents().coordinates);
  std::vector<NodePlace> own;
  nodes.for_nodes([&](const NodeRows& rows) {
    for (std::size_t i = 0; i < rows.ids.size(); ++i) {
      NodePlace place{rows.first + static_cast<std::int64_t>(i), {}};
      if (!places.contains(place.number)) continue;
      std::copy_n(rows.x.begin() + static_cast<std::ptrdiff_t>(coordinates * i), coordinates,
                  place.x.begin());
      own.push_back(place);
    }
  });
  for (const NodePlace& place : of_all_ranks(comm, own)) places[place.number] = place.x;
  return places;
}

// The closed loops that edges form, which pass each node once. As many edges end at a node as begin
// there, so every walk along edges returns to its start.
class Walks {
 public:
  explicit Walks(const std::vector<LoopEdge>& edges) : edges_(edges), is_used_(edges.size()) {}

  std::vector<std::vector<LoopEdge>> all() {
    for (std::size_t first = 0; first < edges_.size(); ++first)
      if (!is_used_[first]) walk_from(first);
    return std::move(loops_);
  }

 private:
  void walk_from(std::size_t first) {
    std::vector<LoopEdge> way;
    // Index in `way` of the edge that begins at the node.
    std::unordered_map<std::int64_t, std::size_t> step;
    for (std::size_t next = first;;) {
      const LoopEdge& edge = edges_[next];
      is_used_[next] = true;
      step[edge.begin] = way.size();
      way.push_back(edge);
      if (const auto met = step.find(edge.end); met != step.end()) {
        const auto begin = way.begin() + static_cast<std::ptrdiff_t>(met->second);
        for (auto past = begin; past != way.end(); ++past) step.erase(past->begin);
        loops_.emplace_back(begin, way.end());
        way.erase(begin, way.end());
        if (way.empty()) return;
      }
      next = unused_from(edge.end);
    }
  }

  std::size_t unused_from(std::int64_t node) const {
    auto edge = std::ranges::lower_bound(edges_, node, {}, &LoopEdge::begin);
    while (edge != edges_.end() && edge->begin == node &&
           is_used_[static_cast<std::size_t>(edge - edges_.begin())])
      ++edge;
    if (edge == edges_.end() || edge->begin != node)
      throw Error(ErrorKind::internal, "the boundary of the domain ends at a node");
    return static_cast<std::size_t>(edge - edges_.begin());
  }

  const std::vector<LoopEdge>& edges_;
  std::vector<bool> is_used_;
  std::vector<std::vector<LoopEdge>> loops_;
};

// Returns whether the loop goes around an island, by its signed area.
bool is_island_in_plane(const std::vector<LoopEdge>& loop, const Places& places) {
  const Point<3>& o = places.at(loop.front().begin);
  double twice_area = 0;
  for (const LoopEdge& edge : loop) {
    const Point<3>&a = places.at(edge.begin), &b = places.at(edge.end);
    twice_area += (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
  }
  return twice_area < 0;
}

// Returns whether the loop goes around an island. Sums the solid angles of the triangles between
// its first node and its edges, as seen from the centre of the sphere.
bool is_island_on_sphere(const std::vector<LoopEdge>& loop, const Places& places) {
  const Point<3>& o = places.at(loop.front().begin);
  double on_left = 0;  // share of the sphere on the left, modulo 1
  for (const LoopEdge& edge : loop)
    if (edge.begin != loop.front().begin && edge.end != loop.front().begin)
      on_left += winding_of({o, places.at(edge.begin), places.at(edge.end)}, {});
  return on_left - std::floor(on_left) > 0.5;
}

// Returns a chain of `count` edges of the loop from edge `begin` on.
BoundaryChain chain_from(const std::vector<LoopEdge>& edges, std::size_t begin, std::size_t count,
                         std::int32_t kind, bool is_island) {
  BoundaryChain chain{{edges[begin].begin}, kind, count == edges.size(), is_island};
  for (std::size_t k = 0; k < count; ++k)
    chain.nodes.push_back(edges[(begin + k) % edges.size()].end);
  return chain;
}

}  // namespace

std::vector<BoundaryLoop> boundary_loops(const NodeSource& nodes, const Communicator& comm) {
  const std::vector<LoopEdge> edges = bounding_edges(nodes, comm);
  const Places places = places_of(edges, nodes, comm);
  const bool on_sphere = nodes.contents().coordinates == 3;
  std::vector<BoundaryLoop> loops;
  for (std::vector<LoopEdge>& loop : Walks(edges).all()) {
    const bool is_island =
        on_sphere ? is_island_on_sphere(loop, places) : is_island_in_plane(loop, places);
    loops.push_back({std::move(loop), is_island});
  }
  std::ranges::stable_sort(loops, {}, &BoundaryLoop::is_island);
  return loops;
}

std::vector<BoundaryChain> chains_of(const std::vector<BoundaryLoop>& loops,
                                     const std::function<std::int32_t(std::int32_t)>& kind_of) {
  std::vector<BoundaryChain> chains;
  for (const BoundaryLoop& loop : loops) {
    const std::size_t n = loop.edges.size();
    std::vector<std::int32_t> kinds;
    for (const LoopEdge& edge : loop.edges) kinds.push_back(kind_of(edge.tag));
    std::vector<std::size_t> begins;
    for (std::size_t k = 0; k < n; ++k)
      if (kinds[k] != kinds[(k + n - 1) % n]) begins.push_back(k);
    if (begins.empty()) begins.push_back(0);
    for (std::size_t k = 0; k < begins.size(); ++k) {
      const std::size_t end = k + 1 < begins.size() ? begins[k + 1] : begins[0] + n;
      chains.push_back(
          chain_from(loop.edges, begins[k], end - begins[k], kinds[begins[k]], loop.is_island));
    }
  }
  return chains;
}

}  // namespace pnpbs::io
