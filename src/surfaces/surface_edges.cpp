// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces/surface_edges.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

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

}  // namespace pnpbs
