// SPDX-License-Identifier: BSD-3-Clause
// A mesh, its features and its surface, which refer to each other.
#pragma once

#include <cstdint>
#include <utility>

#include "base/limits.hpp"
#include "domain/volume/surface.hpp"
#include "space_shapes.hpp"

namespace space_shapes {

struct SurfaceCase {
  Mesh mesh;
  pnpbs::Features features;
  pnpbs::Surface surface;

  explicit SurfaceCase(Mesh m)
      : mesh(std::move(m)), features(pnpbs::find_features(mesh, 40)), surface(mesh, features) {}
  SurfaceCase(const SurfaceCase&) = delete;

  std::int32_t facet_count() const { return static_cast<std::int32_t>(mesh.facets.size()); }
  pnpbs::Box<3> bounds() const {
    pnpbs::Box<3> box{};
    if (!mesh.nodes.empty()) box = {mesh.nodes[0].position, mesh.nodes[0].position};
    for (const auto& node : mesh.nodes) include(box, node.position);
    return box;
  }
  // Returns a point of a facet, by the fractions of its two edges from the first corner.
  P point(std::int32_t f, double v, double w) const {
    const auto [a, b, c] = surface.corners(f);
    return pnpbs::shifted(pnpbs::shifted(a, v, pnpbs::difference(b, a)), w,
                          pnpbs::difference(c, a));
  }
  pnpbs::SurfacePoint centre(std::int32_t f) const { return {f, point(f, 1.0 / 3, 1.0 / 3)}; }
};

}  // namespace space_shapes
