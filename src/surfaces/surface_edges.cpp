// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces/surface_edges.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/error.hpp"

namespace pnpbs {

SurfaceEdges::SurfaceEdges(const Triangulation& surface) {
  std::vector<std::pair<std::array<std::int32_t, 2>, EdgeSide>> all;
  all.reserve(3 * surface.triangles.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (std::int32_t k = 0; k < 3; ++k) {
      const std::int32_t a = surface.triangles[t].vertices[k];
      const std::int32_t b = surface.triangles[t].vertices[(k + 1) % 3];
      all.push_back({{std::min(a, b), std::max(a, b)}, {static_cast<std::int32_t>(t), k, a < b}});
    }
  const auto key = [&](const auto& entry) {
    const EdgeSide& side = entry.second;
    return std::tuple(entry.first, surface.triangles[side.triangle].inner, side.corner());
  };
  std::sort(all.begin(), all.end(), [&](const auto& x, const auto& y) {
    return x.first != y.first ? x.first < y.first : key(x) < key(y);
  });
  sides_.reserve(all.size());
  for (const auto& [ends, side] : all) {
    if (ends_.empty() || ends_.back() != ends) {
      ends_.push_back(ends);
      first_.push_back(sides_.size());
      first_inner_.push_back(sides_.size());
    }
    sides_.push_back(side);
    if (!surface.triangles[side.triangle].inner) first_inner_.back() = sides_.size();
  }
  first_.push_back(sides_.size());
}

UnionFind<std::int32_t> connected_triangles(const Triangulation& surface,
                                            const SurfaceEdges& edges) {
  UnionFind<std::int32_t> connected(surface.triangles.size());
  for (std::size_t e = 0; e < edges.count(); ++e)
    for (const EdgeSide& side : edges.sides(e))
      connected.join(edges.sides(e)[0].triangle, side.triangle);
  return connected;
}

namespace {

// The triangle across an edge, if there is exactly one, and whether it has the same orientation.
struct Neighbour {
  std::int32_t triangle = -1;
  bool agrees = false;
};
using Neighbours = std::vector<std::array<Neighbour, 3>>;

Neighbours find_neighbours(const Triangulation& surface, const SurfaceEdges& edges) {
  Neighbours neighbours(surface.triangles.size());
  const auto join = [&](std::span<const EdgeSide> sides) {
    if (sides.size() != 2) return;
    const bool agrees = sides[0].forward != sides[1].forward;
    neighbours[sides[0].triangle][sides[0].k] = {sides[1].triangle, agrees};
    neighbours[sides[1].triangle][sides[1].k] = {sides[0].triangle, agrees};
  };
  for (std::size_t e = 0; e < edges.count(); ++e) {
    join(edges.boundary_sides(e));
    join(edges.inner_sides(e));
  }
  return neighbours;
}

[[noreturn]] void reject_one_sided(const Triangulation& surface, std::int32_t t, std::int32_t k,
                                   std::int32_t other) {
  throw BrokenSurface(
      "the surface has one side only, like a Moebius strip: " + surface.triangle_name(t) + " and " +
      surface.triangle_name(other) + " cannot be oriented consistently at " +
      surface.vertex_name(surface.triangles[t].vertices[k]));
}

// Returns the triangles connected with the first one. Sets `turned` of each to 1 if it must be
// turned to agree with the first, else to 0.
std::vector<std::int32_t> connected_with(std::int32_t first, const Triangulation& surface,
                                         const Neighbours& neighbours, OneSided one_sided,
                                         std::vector<signed char>& turned) {
  std::vector<std::int32_t> reached{first};
  turned[first] = 0;
  for (std::size_t next = 0; next < reached.size(); ++next) {
    const std::int32_t t = reached[next];
    for (std::int32_t k = 0; k < 3; ++k) {
      const Neighbour& neighbour = neighbours[t][k];
      if (neighbour.triangle < 0) continue;
      const auto wanted = static_cast<signed char>(neighbour.agrees ? turned[t] : 1 - turned[t]);
      signed char& there = turned[neighbour.triangle];
      if (there < 0) {
        there = wanted;
        reached.push_back(neighbour.triangle);
      } else if (there != wanted && one_sided == OneSided::rejected) {
        reject_one_sided(surface, t, k, neighbour.triangle);
      }
    }
  }
  return reached;
}

}  // namespace

void orient_surfaces(Triangulation& surface, SurfaceEdges& edges, OneSided one_sided,
                     std::vector<Warning>& warnings) {
  const Neighbours neighbours = find_neighbours(surface, edges);
  const auto count = static_cast<std::int32_t>(surface.triangles.size());
  std::vector<signed char> turned(count, -1);  // -1: not known yet
  for (std::int32_t first = 0; first < count; ++first) {
    if (turned[first] >= 0) continue;
    const std::vector<std::int32_t> connected =
        connected_with(first, surface, neighbours, one_sided, turned);
    std::size_t turns = 0;
    for (const std::int32_t t : connected) turns += turned[t] == 1 ? 1 : 0;
    if (2 * turns <= connected.size()) continue;
    for (const std::int32_t t : connected) turned[t] = static_cast<signed char>(1 - turned[t]);
  }
  std::int64_t turns = 0;
  std::string name;
  for (std::int32_t t = 0; t < count; ++t) {
    if (turned[t] == 0) continue;
    if (turns++ == 0) name = surface.triangle_name(t);
    surface.triangles[t].turn_around();
  }
  if (turns == 0) return;
  edges = SurfaceEdges(surface);
  warnings.emplace_back(WarningCode::triangles_turned,
                        std::to_string(turns) + (turns == 1 ? " triangle was" : " triangles were") +
                            " reversed to be oriented as the neighbours are; the first is " + name,
                        turns);
}

}  // namespace pnpbs
