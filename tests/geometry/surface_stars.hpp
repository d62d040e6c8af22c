// SPDX-License-Identifier: BSD-3-Clause
// Nodes on a surface, on its features and at random points between them, and their stars.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "core/random.hpp"
#include "delaunay/volume/tangent_star.hpp"
#include "domain/volume/feature_nodes.hpp"
#include "surface_case.hpp"

namespace space_shapes {

struct PlacedNode {
  P position;
  pnpbs::SurfaceSupport place;
};

using StarTriangle = std::array<std::int32_t, 3>;

// Returns the same triangle with the same orientation and the smallest index first.
inline StarTriangle sorted_triangle(StarTriangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

class StarredSurface {
  using On = pnpbs::SurfaceSupport::On;

 public:
  // Nodes on features have the first indices.
  StarredSurface(const SurfaceCase& c, double d)
      : c_(c), d_(d), laid_(place_feature_nodes(c.mesh, c.features, constant(d))) {
    for (const pnpbs::FeatureNode& node : laid_.nodes)
      nodes.push_back({node.position, node.corner >= 0
                                          ? pnpbs::SurfaceSupport{On::corner, node.corner}
                                          : pnpbs::SurfaceSupport{On::edge, node.edge}});
    for (const std::vector<std::int32_t>& row : laid_.along)
      for (std::size_t n = 0; n + 1 < row.size(); ++n)
        joined_.insert(std::minmax(row[n], row[n + 1]));
  }

  void add(const pnpbs::SurfacePoint& at) { nodes.push_back({at.position, {On::facet, at.facet}}); }

  // Adds random nodes at least 0.7 d from each other and d/2 from features until no more fit. The
  // facets should have about equal sizes.
  void throw_nodes(Random& random) {
    for (int misses = 0; misses < 2000; ++misses) {
      const auto f = static_cast<std::int32_t>(random.below(c_.facet_count()));
      double v = random.between(0, 1), w = random.between(0, 1);
      if (v + w > 1) {
        v = 1 - v;
        w = 1 - w;
      }
      const pnpbs::SurfacePoint at{f, c_.point(f, v, w)};
      const bool close = std::any_of(nodes.begin(), nodes.end(), [&](const PlacedNode& node) {
        return c_.surface.sees({On::facet, f}, node.place) &&
               pnpbs::distance<3>(node.position, at.position) < 0.7 * d_;
      });
      if (close || c_.surface.feature_clearance(at, d_) < 0.5 * d_) continue;
      add(at);
      misses = 0;
    }
  }

  // Returns the star built from all visible nodes within `reach`; empty if that is not sufficient.
  std::vector<pnpbs::SurfaceStarEntry> star_of(std::int32_t i, double reach) const {
    const PlacedNode& node = nodes[static_cast<std::size_t>(i)];
    std::vector<pnpbs::StarSide> sides;
    c_.surface.for_sides(node.place, [&](const pnpbs::SurfaceSide& side) {
      pnpbs::StarSide& own = sides.emplace_back();
      own.normal = side.normal;
      own.first = side.begin.curve < 0 ? -1 : laid_.next(i, side.begin);
      own.last = side.end.curve < 0 ? -1 : laid_.next(i, side.end);
      for (std::int32_t j = 0; j < static_cast<std::int32_t>(nodes.size()); ++j) {
        const PlacedNode& other = nodes[static_cast<std::size_t>(j)];
        const bool near = pnpbs::distance<3>(node.position, other.position) <= reach;
        if (j != i && near && c_.surface.sees(side, other.place))
          own.around.push_back({other.position, j, j});
      }
    });
    std::vector<pnpbs::SurfaceStarEntry> star;
    tangent_star(
        {node.position, i, i}, reach, sides,
        [&](std::int32_t a, std::int32_t b) { return joined_.contains(std::minmax(a, b)); }, star);
    return star;
  }

  // Counts the stars that contain each triangle. A consistent triangle is in three stars.
  std::multiset<StarTriangle> triangles(double reach) const {
    std::multiset<StarTriangle> all;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(nodes.size()); ++i) {
      const std::vector<pnpbs::SurfaceStarEntry> star = star_of(i, reach);
      for (std::size_t k = 0; k < star.size(); ++k)
        if (star[k].triangle)
          all.insert(sorted_triangle({i, star[k].node, star[(k + 1) % star.size()].node}));
    }
    return all;
  }

  std::vector<PlacedNode> nodes;

 private:
  const SurfaceCase& c_;
  double d_;
  pnpbs::FeatureNodes laid_;
  std::set<std::pair<std::int32_t, std::int32_t>> joined_;
};

// Returns the fraction of triangles that are not in the stars of all three nodes.
inline double disagreement(const std::multiset<StarTriangle>& triangles) {
  double all = 0, apart = 0;
  for (auto t = triangles.begin(); t != triangles.end(); t = triangles.upper_bound(*t)) {
    ++all;
    apart += triangles.count(*t) != 3;
  }
  return apart / all;
}

}  // namespace space_shapes
