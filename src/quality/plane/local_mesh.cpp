// SPDX-License-Identifier: BSD-3-Clause
#include "quality/plane/local_mesh.hpp"

#include <algorithm>

#include "base/nodes.hpp"
#include "method/constants.hpp"
#include "predicates/plane.hpp"
#include "quality/triangle_quality.hpp"

namespace pnpbs {

namespace {

std::size_t at(std::int32_t place) { return static_cast<std::size_t>(place); }

}  // namespace

bool LocalMesh::Triangle::has(std::int32_t place) const {
  return corner[0] == place || corner[1] == place || corner[2] == place;
}

int LocalMesh::Triangle::side_towards(std::int32_t triangle) const {
  return across[0] == triangle ? 0 : across[1] == triangle ? 1 : 2;
}

double LocalMesh::twice_area(const Triangle& t) const {
  const Point<2>&a = x_[at(t.corner[0])], &b = x_[at(t.corner[1])], &c = x_[at(t.corner[2])];
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

double LocalMesh::quality_of(const Corners& corner) const {
  return triangle_quality(x_[at(corner[0])], x_[at(corner[1])], x_[at(corner[2])]);
}

double LocalMesh::gap_at(const Point<2>& x) const {
  double gap = kFarAway;
  for (const Point<2>& y : x_) gap = std::min(gap, distance<2>(x, y));
  return gap;
}

MeshQuality LocalMesh::quality() const {
  MeshQuality all{0, 1};
  for (const Triangle& t : triangles_) {
    const double q = quality_of(t.corner);
    all.loss += (1 - q) * (1 - q);
    all.min = std::min(all.min, q);
  }
  return all;
}

// ------------------------------------------------------------------ making it ------------------

void LocalMesh::clear() {
  x_.clear();
  moves_.clear();
  triangles_.clear();
}

void LocalMesh::add_node(const Point<2>& x, bool moves) {
  x_.push_back(x);
  moves_.push_back(moves);
}

void LocalMesh::add_triangle(const Corners& corners) {
  triangles_.push_back({corners, {-1, -1, -1}});
}

std::vector<LocalMesh::Corners> LocalMesh::triangles() const {
  std::vector<Corners> all;
  for (const Triangle& t : triangles_) all.push_back(t.corner);
  return all;
}

// Each unmatched side is stored in a linked list at its corner with the smaller index until the
// adjacent triangle is found.
void LocalMesh::link_triangles() {
  constexpr std::int32_t kNone = -1;
  std::vector<std::int32_t> first(x_.size(), kNone), next(3 * triangles_.size(), kNone);
  const auto side_corners = [&](std::int32_t side) {
    const Corners& corner = triangles_[at(side / 3)].corner;
    return std::minmax({corner[at((side + 1) % 3)], corner[at((side + 2) % 3)]});
  };
  for (std::int32_t side = 0; side < static_cast<std::int32_t>(next.size()); ++side) {
    triangles_[at(side / 3)].across[at(side % 3)] = kNone;
    const auto corners = side_corners(side);
    std::int32_t& begin = first[at(corners.first)];
    std::int32_t other = begin;
    while (other != kNone && side_corners(other) != corners) other = next[at(other)];
    if (other != kNone) {
      triangles_[at(side / 3)].across[at(side % 3)] = other / 3;
      triangles_[at(other / 3)].across[at(other % 3)] = side / 3;
    } else {
      next[at(side)] = begin;
      begin = side;
    }
  }
}

// ------------------------------------------------------------------ nodes that come or go ------

std::int32_t LocalMesh::largest_triangle_at(std::int32_t place) const {
  return largest_triangle_at(place, place);
}

std::int32_t LocalMesh::largest_triangle_at(std::int32_t place, std::int32_t other) const {
  std::int32_t largest = -1;
  double max_area = 0;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    if (!triangles_[t].has(place) || !triangles_[t].has(other)) continue;
    const double area = twice_area(triangles_[t]);
    if (area <= max_area) continue;
    max_area = area;
    largest = static_cast<std::int32_t>(t);
  }
  return largest;
}

std::int32_t LocalMesh::insert(std::int32_t triangle) {
  const auto [a, b, c] = triangles_[at(triangle)].corner;
  Point<2> middle;
  for (int k = 0; k < 2; ++k) middle[k] = (x_[at(a)][k] + x_[at(b)][k] + x_[at(c)][k]) / 3;
  const auto place = static_cast<std::int32_t>(x_.size());
  add_node(middle, true);
  triangles_[at(triangle)].corner = {a, b, place};
  add_triangle({b, c, place});
  add_triangle({c, a, place});
  link_triangles();
  return place;
}

// Returns the neighbours of a node in counter-clockwise order, or an empty list if they do not
// close a ring.
std::vector<std::int32_t> LocalMesh::ring_around(std::int32_t place) const {
  std::vector<std::array<std::int32_t, 2>> edges;
  for (const Triangle& t : triangles_)
    for (std::size_t k = 0; k < 3; ++k)
      if (t.corner[k] == place) edges.push_back({t.corner[(k + 1) % 3], t.corner[(k + 2) % 3]});
  std::vector<std::int32_t> ring;
  while (ring.size() < edges.size()) {
    const std::int32_t next = ring.empty() ? edges.front()[0] : ring.back();
    const auto edge =
        std::find_if(edges.begin(), edges.end(), [&](const auto& e) { return e[0] == next; });
    if (edge == edges.end()) return {};
    ring.push_back((*edge)[1]);
  }
  if (ring.empty() || ring.back() != edges.front()[0]) return {};
  return ring;
}

bool LocalMesh::remove(std::int32_t place) {
  const std::vector<std::int32_t> ring = ring_around(place);
  std::erase_if(triangles_, [&](const Triangle& t) { return t.has(place); });
  moves_[at(place)] = 0;
  if (!fill(ring)) return false;
  link_triangles();
  return true;
}

// Returns whether the node lies in the closed triangle `ear` without being one of its corners.
bool LocalMesh::in_ear(const Corners& ear, std::int32_t place) const {
  const Point<2>& x = x_[at(place)];
  return !(Triangle{ear, {}}.has(place)) && orientation(x_[at(ear[0])], x_[at(ear[1])], x) >= 0 &&
         orientation(x_[at(ear[1])], x_[at(ear[2])], x) >= 0 &&
         orientation(x_[at(ear[2])], x_[at(ear[0])], x) >= 0;
}

// Triangulates a hole by repeatedly cutting off the ear of the best quality.
bool LocalMesh::fill(std::vector<std::int32_t> ring) {
  while (ring.size() >= 3) {
    const std::size_t n = ring.size();
    Corners best{};
    std::size_t tip = n;
    for (std::size_t k = 0; k < n; ++k) {
      const Corners ear{ring[(k + n - 1) % n], ring[k], ring[(k + 1) % n]};
      const double at_least = tip < n ? quality_of(best) : 0;
      if (quality_of(ear) <= at_least ||
          std::any_of(ring.begin(), ring.end(), [&](std::int32_t p) { return in_ear(ear, p); }))
        continue;
      best = ear;
      tip = k;
    }
    if (tip == n) return false;
    add_triangle(best);
    if (n == 3) return true;
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(tip));
  }
  return false;
}

// ------------------------------------------------------------------ relaxing -------------------

void LocalMesh::relax() {
  for (int step = 0; step < method::kPatchSteps; ++step) {
    if (step % method::kPatchStepsBetweenFlips == 0) {
      make_delaunay();
      collect_edges();
    }
    step_to_means();
  }
  make_delaunay();
}

void LocalMesh::collect_edges() {
  edges_.clear();
  neighbours_.assign(x_.size(), 0);
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Triangle& own = triangles_[t];
      if (own.across[k] >= static_cast<std::int32_t>(t)) continue;
      const std::int32_t a = own.corner[(k + 1) % 3], b = own.corner[(k + 2) % 3];
      edges_.push_back({a, b});
      ++neighbours_[at(a)];
      ++neighbours_[at(b)];
    }
}

void LocalMesh::step_to_means() {
  sum_.assign(x_.size(), {0, 0});
  for (const auto& [a, b] : edges_)
    for (std::size_t k = 0; k < 2; ++k) {
      sum_[at(a)][k] += x_[at(b)][k];
      sum_[at(b)][k] += x_[at(a)][k];
    }
  for (std::size_t i = 0; i < x_.size(); ++i) {
    if (!moves_[i]) continue;
    for (std::size_t k = 0; k < 2; ++k)
      x_[i][k] += method::kPatchWay * (sum_[i][k] / neighbours_[i] - x_[i][k]);
  }
}

void LocalMesh::make_delaunay() {
  constexpr int kMaxPasses = 20;
  bool flipped = true;
  for (int pass = 0; pass < kMaxPasses && flipped; ++pass) {
    flipped = false;
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(triangles_.size()); ++t)
      for (int side = 0; side < 3; ++side)
        if (flip(t, side)) flipped = true;
  }
}

// Flips the edge of triangle t = (a, b, c) opposite to a if the adjacent triangle u = (d, c, b) has
// d inside the circumcircle of t. The triangles become (a, b, d) and (a, d, c). Edges between two
// fixed nodes are never flipped.
bool LocalMesh::flip(std::int32_t t, int side) {
  Triangle& own = triangles_[at(t)];
  const std::int32_t u = own.across[at(side)];
  if (u < t) return false;  // no triangle, or the pair is treated from u
  Triangle& other = triangles_[at(u)];
  const int back = other.side_towards(t);
  const std::size_t at_a = at(side), at_b = at((side + 1) % 3), at_c = at((side + 2) % 3);
  const std::size_t at_d = at(back), c_at_d = at((back + 1) % 3), b_at_d = at((back + 2) % 3);
  const std::int32_t a = own.corner[at_a], b = own.corner[at_b], c = own.corner[at_c],
                     d = other.corner[at_d];
  if (!moves_[at(b)] && !moves_[at(c)]) return false;
  const Point<2>&xa = x_[at(a)], &xb = x_[at(b)], &xc = x_[at(c)], &xd = x_[at(d)];
  if (in_circle(xa, xb, xc, xd) <= 0 || orientation(xa, xb, xd) <= 0 ||
      orientation(xa, xd, xc) <= 0)
    return false;
  const std::int32_t beyond_ab = own.across[at_c], beyond_ca = own.across[at_b],
                     beyond_bd = other.across[c_at_d], beyond_dc = other.across[b_at_d];
  own = {{a, b, d}, {beyond_bd, u, beyond_ab}};
  other = {{a, d, c}, {beyond_dc, beyond_ca, t}};
  const auto tell = [&](std::int32_t neighbour, std::int32_t before, std::int32_t now) {
    if (neighbour < 0) return;
    Triangle& there = triangles_[at(neighbour)];
    there.across[at(there.side_towards(before))] = now;
  };
  tell(beyond_bd, u, t);
  tell(beyond_ca, t, u);
  return true;
}

}  // namespace pnpbs
