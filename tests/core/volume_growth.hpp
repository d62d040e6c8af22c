// SPDX-License-Identifier: BSD-3-Clause
// A cube, or an L-shaped block, in which d grows steeply from one point, and the exact limit of its
// growth.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>

#include "geometry/volume/surface_index.hpp"
#include "spacing/line_of_sight.hpp"
#include "spacing/spacing.hpp"
#include "surfaces.hpp"

namespace volume_growth {

class Block {
 public:
  static constexpr double kGrowth = 0.2, kFinest = 0.03, kSlope = 0.7, kCoarsest = 0.3;

  // A block is the unit cube, without the quarter in which x and y exceed 1/2 if it is L-shaped. In
  // integers its sides are 768 and 384.
  Block(bool l_shaped, const pnpbs::Point<3>& finest) : l_shaped_(l_shaped), finest_(finest) {}

  pnpbs::Box<3> bounds() const { return {{0, 0, 0}, {1, 1, 1}}; }
  bool inside(const pnpbs::Point<3>& x) const { return !l_shaped_ || x[0] < 0.5 || x[1] < 0.5; }

  std::unique_ptr<const pnpbs::LineOfSight<3>> ways() const {
    surfaces::Surface surface =
        surfaces::cubes(2, [this](std::int64_t i, std::int64_t j, std::int64_t) {
          return !l_shaped_ || i == 0 || j == 0;
        });
    surface.unit = 1.0 / 16;  // cubes have a width of six
    for (surfaces::Place& x : surface.nodes)
      for (std::int64_t& along : x) along = along / 6 * 8;
    struct Indexed {
      pnpbs::BoundaryMesh<3> mesh;
      pnpbs::SurfaceIndex index;
    };
    const auto indexed = std::make_shared<Indexed>();
    surface.add_to(indexed->mesh, pnpbs::SurfaceRole::boundary);
    indexed->index = pnpbs::SurfaceIndex(indexed->mesh, bounds());
    return std::make_unique<const pnpbs::LineOfSight<3>>(
        bounds(), l_shaped_ ? 0.75 : 1.0,
        std::shared_ptr<const pnpbs::FacetIndex<3>>(indexed, &indexed->index.sides()));
  }

  std::shared_ptr<const pnpbs::Spacing<3>> spacing() const {
    return std::make_shared<pnpbs::CallbackSpacing<3>>(
        [this](std::int64_t n, const double* x, double* d) {
          for (std::int64_t i = 0; i < n; ++i) d[i] = raw({x[3 * i], x[3 * i + 1], x[3 * i + 2]});
          return std::int32_t{0};
        });
  }

  double raw(const pnpbs::Point<3>& x) const {
    return std::min(kCoarsest, kFinest + kSlope * pnpbs::distance<3>(x, finest_));
  }
  double limit(const pnpbs::Point<3>& x) const {
    return std::min(raw(x), kFinest + kGrowth * way_from_finest(x));
  }

 private:
  // Returns the length of the shortest path within the block: straight, or around the inner edge.
  double way_from_finest(const pnpbs::Point<3>& x) const {
    if (!l_shaped_ || !passes_the_quarter(x)) return pnpbs::distance<3>(x, finest_);
    const auto to_edge = [](const pnpbs::Point<3>& p) {
      return std::hypot(p[0] - 0.5, p[1] - 0.5);
    };
    return std::hypot(to_edge(x) + to_edge(finest_), x[2] - finest_[2]);
  }
  // Returns whether the straight segment crosses the missing quarter: the finest point is in one
  // arm, x in the other, and the edge lies on the inner side, seen from above.
  bool passes_the_quarter(const pnpbs::Point<3>& x) const {
    const double side =
        (x[0] - finest_[0]) * (0.5 - finest_[1]) - (x[1] - finest_[1]) * (0.5 - finest_[0]);
    return finest_[0] > 0.5 && x[1] > 0.5 && side > 0;
  }

  bool l_shaped_;
  pnpbs::Point<3> finest_;
};

}  // namespace volume_growth
