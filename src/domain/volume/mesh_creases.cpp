// SPDX-License-Identifier: BSD-3-Clause
#include "domain/volume/mesh_creases.hpp"

#include <algorithm>
#include <cstddef>

#include "base/index.hpp"

namespace pnpbs {

namespace {}  // namespace

std::vector<SurfaceCrease> join_creases(const std::vector<SurfaceSource>& surfaces,
                                        const std::vector<std::int32_t>& joined) {
  std::vector<SurfaceCrease> creases;
  std::int32_t first = 0;
  for (const SurfaceSource& surface : surfaces) {
    for (SurfaceCrease crease : surface.creases) {
      for (std::int32_t& v : crease.vertices) v = joined[index(first + v)];
      creases.push_back(crease);
    }
    first += static_cast<std::int32_t>(surface.vertices.size());
  }
  return creases;
}

std::vector<LevelSetCrease> creases_between(const std::vector<SurfaceCrease>& creases,
                                            const std::vector<std::int32_t>& node) {
  std::vector<LevelSetCrease> between;
  for (const SurfaceCrease& crease : creases) {
    const std::int32_t a = node[index(crease.vertices[0])], b = node[index(crease.vertices[1])];
    if (a < 0 || b < 0 || a == b) continue;
    const auto& [left, right] = crease.normals;
    between.push_back(a < b ? LevelSetCrease{{a, b}, {left, right}}
                            : LevelSetCrease{{b, a}, {right, left}});
  }
  std::sort(between.begin(), between.end(),
            [](const LevelSetCrease& a, const LevelSetCrease& b) { return a.nodes < b.nodes; });
  return between;
}

}  // namespace pnpbs
