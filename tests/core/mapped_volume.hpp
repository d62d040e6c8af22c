// SPDX-License-Identifier: BSD-3-Clause
// A triangulated surface in a background tree that its spacing refines.
#pragma once

#include <algorithm>
#include <functional>
#include <utility>

#include "spacing/sized_tree.hpp"
#include "surfaces.hpp"

using VolumeSpacing = std::function<double(const pnpbs::Point<3>&)>;

inline pnpbs::SpacingEvaluator<3> evaluator_of(const VolumeSpacing& d) {
  return [d](std::int64_t n, const pnpbs::Point<3>* x, double* values) {
    for (std::int64_t i = 0; i < n; ++i) values[i] = d(x[i]);
  };
}

inline VolumeSpacing constant(double d) {
  return [d](const pnpbs::Point<3>&) { return d; };
}

struct Mapped {
  surfaces::Surface surface;
  pnpbs::BoundaryMesh<3> mesh;
  pnpbs::SizedTree<3> map;

  Mapped(surfaces::Surface s, const VolumeSpacing& d, std::int64_t max_nodes = 1'000'000'000)
      : surface(std::move(s)) {
    surface.add_to(mesh, pnpbs::SurfaceRole::boundary);
    map.build(surface.bounds(), mesh, evaluator_of(d), max_nodes);
  }
  Mapped(const Mapped&) = delete;

  double size() const {
    const pnpbs::Box<3> box = surface.bounds();
    return std::max({box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]});
  }
  std::size_t count() const { return surface.triangles.size(); }
};

inline surfaces::Surface scaled(surfaces::Surface s, double unit) {
  s.unit = unit;
  return s;
}
