// SPDX-License-Identifier: BSD-3-Clause
#include "level/volume/boundary_euler.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "level/volume/open_faces.hpp"

namespace pnpbs {

namespace {

using Counts = std::array<std::int64_t, 3>;  // of vertices, edges and triangles

std::int64_t euler_of(const Counts& counts) { return counts[0] - counts[1] + counts[2]; }

template <class T>
std::int64_t distinct(std::vector<T>& values) {
  std::ranges::sort(values);
  return std::unique(values.begin(), values.end()) - values.begin();
}

}  // namespace

std::int64_t euler_of_surfaces(const Level<3>& level) {
  const BoundaryMesh<3>& mesh = level.ground.boundary();
  const Features& features = level.ground.domain().features();
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
  return euler_of({distinct(vertices), distinct(edges), triangles});
}

// Each node's share is its owner's: an edge is seen from both of its ends, a triangle from its
// corners.
std::int64_t euler_of_boundary(const Level<3>& level) {
  Counts own{};
  agreed(*level.comm, [&] {
    for (std::int64_t i = 0; i < level.nodes.count; ++i) {
      if (!level.nodes.owned(i)) continue;
      const FaceFan fan = open_faces(level, i);
      std::vector<std::int32_t> others;
      for (const auto& [a, b] : fan) others.insert(others.end(), {a, b});
      own[0] += !fan.empty();
      own[1] += distinct(others);
      own[2] += std::ssize(fan);
    }
  });
  Counts all;
  for (std::size_t k = 0; k < 3; ++k)
    all[k] =
        static_cast<std::int64_t>(level.comm->allreduce_sum(static_cast<std::uint64_t>(own[k])));
  return euler_of({all[0], all[1] / 2, all[2] / 3});
}

}  // namespace pnpbs
