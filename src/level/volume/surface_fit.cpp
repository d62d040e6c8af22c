// SPDX-License-Identifier: BSD-3-Clause
#include "level/volume/surface_fit.hpp"

#include <algorithm>
#include <array>

#include "base/found_indices.hpp"
#include "geometry/volume/triangle_samples.hpp"
#include "level/found_nodes.hpp"
#include "level/level.hpp"
#include "level/volume/open_faces.hpp"

namespace pnpbs {

namespace {

// Returns whether a face of node i is far from the surfaces. It is tested at its corner with the
// smallest id.
bool is_off(const Level<3>& level, std::int64_t i, const FaceSide& others) {
  const Nodes<3>& nodes = level.nodes;
  const auto [a, b] = others;
  if (nodes.id(a) < nodes.id(i) || nodes.id(b) < nodes.id(i)) return false;
  const double reach = std::min({nodes.d(i), nodes.d(a), nodes.d(b)});
  const auto samples = triangle_samples({nodes.position(i), nodes.position(a), nodes.position(b)});
  return std::ranges::any_of(samples, [&](const Point<3>& x) {
    return level.geometry.domain().index().clearance(x, reach) >= reach;
  });
}

std::int64_t faces_off_at(const Level<3>& level, std::int64_t i) {
  if (!level.nodes.owned(i)) return 0;
  return std::ranges::count_if(open_faces(level, i),
                               [&](const FaceSide& side) { return is_off(level, i, side); });
}

}  // namespace

SurfaceFit measure_surface_fit(const Level<3>& level) {
  const Nodes<3>& nodes = level.nodes;
  if (level.geometry.kind() != GeometryKind::body) return {};
  FoundNodes<3> off;
  std::vector<Point<3>> places;
  collective_try(*level.comm, [&] {
    for (const std::int64_t i :
         indices_where("pnpbs::surface_fit", nodes.count,
                       [&](std::int64_t k) { return faces_off_at(level, k) > 0; })) {
      off.add(faces_off_at(level, i), nodes.id(i), nodes.position(i));
      places.push_back(nodes.position(i));
    }
  });
  off = over_ranks(*level.comm, off);
  return {off.count, off.at, std::move(places)};
}

}  // namespace pnpbs
