// SPDX-License-Identifier: BSD-3-Clause
#include "level/volume/boundary_euler.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "level/volume/open_faces.hpp"

namespace pnpbs {

namespace {

// Numbers of vertices, edges and triangles of a triangulated surface.
struct Counts {
  std::int64_t vertices = 0, edges = 0, triangles = 0;

  void add(const Counts& more) {
    vertices += more.vertices;
    edges += more.edges;
    triangles += more.triangles;
  }
  std::int64_t euler() const { return vertices - edges + triangles; }
};

template <class T>
std::int64_t distinct(std::vector<T>& values) {
  std::ranges::sort(values);
  return std::unique(values.begin(), values.end()) - values.begin();
}

// Adds the vertex i and the edges and triangles at it.
void add_faces_at(const Level<3>& level, std::int64_t i, Counts& counts) {
  const FaceFan fan = open_faces(level, i);
  if (fan.empty()) return;
  std::vector<std::int32_t> others;
  for (const auto& [a, b] : fan) others.insert(others.end(), {a, b});
  ++counts.vertices;
  counts.edges += distinct(others);
  counts.triangles += std::ssize(fan);
}

}  // namespace

std::int64_t euler_of_surfaces(const Level<3>& level) {
  const BoundaryMesh<3>& mesh = level.geometry.boundary();
  const Features& features = level.geometry.domain().features();
  std::vector<std::int32_t> vertices;
  std::vector<std::array<std::int32_t, 2>> edges;
  std::int64_t triangles = 0;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    if (features.patch[f] < 0 || !mesh.facets[f].bounds()) continue;
    ++triangles;
    const auto& nodes = mesh.facets[f].nodes;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = nodes[k], b = nodes[(k + 1) % 3];
      vertices.push_back(a);
      edges.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  return Counts{distinct(vertices), distinct(edges), triangles}.euler();
}

// Sums the shares of the owners. An edge is counted at both of its ends, and a triangle at its
// three corners.
std::int64_t euler_of_boundary(const Level<3>& level) {
  std::vector<std::int64_t> all;
  collective_try(*level.comm, [&] {
    const Counts own = sums_over("pnpbs::euler_of_boundary", level.nodes.count, Counts(),
                                 [&](std::int64_t i, Counts& counts) {
                                   if (level.nodes.owned(i)) add_faces_at(level, i, counts);
                                 });
    all = {own.vertices, own.edges, own.triangles};
  });
  level.comm->allreduce_sum(all);
  return Counts{all[0], all[1] / 2, all[2] / 3}.euler();
}

}  // namespace pnpbs
