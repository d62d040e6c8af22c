// SPDX-License-Identifier: BSD-3-Clause
#include "implicit/level_set_surface.hpp"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "base/space_vectors.hpp"
#include "implicit/level_set.hpp"
#include "implicit/level_set_lattice.hpp"

namespace pnpbs {

namespace {

// Distance within which vertices at a lattice point are joined. [resolution] Where the surface
// passes through the point, they coincide up to rounding.
constexpr double kOneVertex = 1e-6;

// Returns the key of a lattice edge with f < 0 at one end: its midpoint in half steps of the
// lattice.
std::uint64_t edge_key(const LatticeIndex& a, const LatticeIndex& b) {
  return LevelSetLattice::key({a[0] + b[0], a[1] + b[1], a[2] + b[2]});
}

std::array<LatticeIndex, 2> ends_of(std::uint64_t edge) {
  const LatticeIndex middle = LevelSetLattice::place(edge);
  std::array<LatticeIndex, 2> ends;
  for (std::size_t k = 0; k < 3; ++k) {
    ends[0][k] = middle[k] / 2;
    ends[1][k] = (middle[k] + 1) / 2;
  }
  return ends;
}

struct CellTetrahedron {
  std::array<LatticeIndex, 4> corners;  // right-handed
  std::array<bool, 4> negative;
};

// Calls visit(tetrahedron) for the six tetrahedra of each crossed cell. Each goes from the lowest
// corner to the highest along the three axes in one of their orders.
template <class Visit>
void for_tetrahedra(const LevelSetLattice& lattice, const Visit& visit) {
  constexpr std::array<std::array<std::size_t, 3>, 6> kOrders{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (const LatticeIndex& cell : lattice.crossed())
    for (std::size_t order = 0; order < kOrders.size(); ++order) {
      CellTetrahedron t;
      LatticeIndex at = t.corners[0] = cell;
      for (std::size_t step = 0; step < 3; ++step) {
        ++at[kOrders[order][step]];
        t.corners[step + 1] = at;
      }
      if (order >= 3) std::swap(t.corners[2], t.corners[3]);
      for (std::size_t k = 0; k < 4; ++k) t.negative[k] = lattice.value(t.corners[k]) < 0;
      visit(t);
    }
}

// Keys of edges, counter-clockwise as seen from outside.
using Polygon = std::vector<std::uint64_t>;

// Returns the polygon in which the surface cuts a tetrahedron: with three or four vertices, or
// empty.
Polygon cut(const CellTetrahedron& t) {
  std::vector<std::size_t> in, out;
  for (std::size_t k = 0; k < 4; ++k) (t.negative[k] ? in : out).push_back(k);
  if (in.empty() || out.empty()) return {};
  std::array<std::size_t, 4> order{};
  std::copy(out.begin(), out.end(), std::copy(in.begin(), in.end(), order.begin()));
  int inversions = 0;
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = a + 1; b < 4; ++b) inversions += order[a] > order[b] ? 1 : 0;
  if (inversions % 2 == 1)  // restores right-handedness among corners of one sign
    in.size() < 3 ? std::swap(order[2], order[3]) : std::swap(order[0], order[1]);
  const auto edge = [&](std::size_t a, std::size_t b) {
    return edge_key(t.corners[order[a]], t.corners[order[b]]);
  };
  if (in.size() == 1) return {edge(0, 1), edge(0, 2), edge(0, 3)};
  if (in.size() == 3) return {edge(3, 0), edge(3, 1), edge(3, 2)};
  return {edge(0, 2), edge(0, 3), edge(1, 3), edge(1, 2)};
}

// ------------------------------------------------------------------ vertices -------------------

// The zeros of f on edges of the lattice, with zeros near a common lattice point joined.
class EdgeVertices {
 public:
  EdgeVertices(const LevelSet& set, const LevelSetLattice& lattice,
               const std::vector<std::uint64_t>& edges)
      : lattice_(lattice), edges_(edges), near_(kOneVertex * set.resolution()) {
    std::vector<CrossedSegment> segments;
    for (const std::uint64_t edge : edges) {
      const auto [low, high] = ends_of(edge);
      segments.push_back(
          {lattice.position(low), lattice.position(high), lattice.value(low), lattice.value(high)});
    }
    zeros_ = zeros_on(set, segments);
    join();
  }

  std::int32_t operator()(std::uint64_t edge) const {
    const auto place = std::lower_bound(edges_.begin(), edges_.end(), edge) - edges_.begin();
    return of_[static_cast<std::size_t>(place)];
  }
  const std::vector<Point<3>>& positions() const { return positions_; }

  // Separates zeros that were joined into these vertices. Returns true if there were any.
  bool separate_zeros(const std::vector<std::int32_t>& vertices) {
    const std::size_t before = apart_.size();
    for (const std::int32_t v : vertices) {
      const auto joined = point_of_.find(v);
      if (joined != point_of_.end()) apart_.insert(joined->second);
    }
    if (apart_.size() == before) return false;
    join();
    return true;
  }

 private:
  // Numbers the vertices. A joined vertex has the position of its first zero.
  void join() {
    of_.clear();
    positions_.clear();
    point_of_.clear();
    std::unordered_map<std::uint64_t, std::int32_t> at;  // vertex at each lattice point
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      auto vertex = static_cast<std::int32_t>(positions_.size());
      Point<3> zero = zeros_[e];
      for (const LatticeIndex& end : ends_of(edges_[e])) {
        if (distance<3>(lattice_.position(end), zero) > near_) continue;
        const std::uint64_t point = LevelSetLattice::key(end);
        if (apart_.contains(point)) {
          zero = moved_off(end, e);
          continue;
        }
        vertex = at.try_emplace(point, vertex).first->second;
        point_of_[vertex] = point;
      }
      of_.push_back(vertex);
      if (vertex == std::ssize(positions_)) positions_.push_back(zero);
    }
  }

  // Returns the zero moved along its edge to the least distance of vertices that are not joined.
  Point<3> moved_off(const LatticeIndex& end, std::size_t e) const {
    const auto [low, high] = ends_of(edges_[e]);
    const Point<3> from = lattice_.position(end);
    const Point<3> way = difference(lattice_.position(end == low ? high : low), from);
    return shifted(from, near_ / length(way), way);
  }

  const LevelSetLattice& lattice_;
  const std::vector<std::uint64_t>& edges_;
  double near_;
  std::vector<Point<3>> zeros_;              // per edge
  std::unordered_set<std::uint64_t> apart_;  // lattice points at which zeros are not joined
  std::unordered_map<std::int32_t, std::uint64_t> point_of_;  // lattice point of each joined vertex
  std::vector<std::int32_t> of_;                              // vertex of each edge
  std::vector<Point<3>> positions_;
};

using Triangles = std::vector<std::array<std::int32_t, 3>>;

Triangles triangles_on(const LevelSetLattice& lattice, const EdgeVertices& vertex) {
  const auto gap = [&](std::int32_t a, std::int32_t b) {
    return squared_distance<3>(vertex.positions()[static_cast<std::size_t>(a)],
                               vertex.positions()[static_cast<std::size_t>(b)]);
  };
  Triangles triangles;
  for_tetrahedra(lattice, [&](const CellTetrahedron& t) {
    std::vector<std::int32_t> v;
    for (const std::uint64_t edge : cut(t))
      if (v.empty() || v.back() != vertex(edge)) v.push_back(vertex(edge));
    if (v.size() > 1 && v.front() == v.back()) v.pop_back();
    if (v.size() == 4 && gap(v[1], v[3]) < gap(v[0], v[2]))  // divide along the shorter diagonal
      std::rotate(v.begin(), v.begin() + 1, v.end());
    for (std::size_t k = 2; k < v.size(); ++k) triangles.push_back({v[0], v[k - 1], v[k]});
  });
  return triangles;
}

// Returns the vertices of sides that do not belong to exactly two triangles of consistent
// orientation.
std::vector<std::int32_t> ends_of_bad_sides(const Triangles& triangles) {
  std::vector<std::array<std::int32_t, 2>> sides;
  for (const auto& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) sides.push_back({t[k], t[(k + 1) % 3]});
  std::sort(sides.begin(), sides.end());
  std::vector<std::int32_t> ends;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const auto [a, b] = sides[k];
    const bool twice = k > 0 && sides[k - 1] == sides[k];
    if (twice || !std::binary_search(sides.begin(), sides.end(), std::array{b, a}))
      ends.insert(ends.end(), {a, b});
  }
  return ends;
}

}  // namespace

SurfaceSource level_set_surface(const LevelSet& set, std::int32_t tag) {
  const LevelSetLattice lattice(set);
  std::vector<std::uint64_t> edges;
  for_tetrahedra(lattice, [&](const CellTetrahedron& t) {
    for (const std::uint64_t edge : cut(t)) edges.push_back(edge);
  });
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  EdgeVertices vertices(set, lattice, edges);
  SurfaceSource surface;
  // If only some of the zeros around a lattice point are joined, the surface may be pinched there.
  do {
    surface.triangles = triangles_on(lattice, vertices);
  } while (vertices.separate_zeros(ends_of_bad_sides(surface.triangles)));
  surface.vertices = vertices.positions();
  surface.tags.assign(surface.triangles.size(), tag);
  return surface;
}

}  // namespace pnpbs
