// SPDX-License-Identifier: BSD-3-Clause
// Badly spaced nodes and the quality of their triangles, for tests of the finish.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "random.hpp"
#include "star_triangles.hpp"

// Returns 2 r_in / R of a triangle from its angles: 8 sin(A/2) sin(B/2) sin(C/2).
inline double quality(const pnpbs::Point<2>& a, const pnpbs::Point<2>& b,
                      const pnpbs::Point<2>& c) {
  if (pnpbs::orientation(a, b, c) < 0) return -quality(a, c, b);
  const auto half_sine = [](const pnpbs::Point<2>& at, const pnpbs::Point<2>& u,
                            const pnpbs::Point<2>& w) {
    const double cross = (u[0] - at[0]) * (w[1] - at[1]) - (u[1] - at[1]) * (w[0] - at[0]);
    const double dot = (u[0] - at[0]) * (w[0] - at[0]) + (u[1] - at[1]) * (w[1] - at[1]);
    return std::sin(0.5 * std::atan2(cross, dot));
  };
  return 8 * half_sine(a, b, c) * half_sine(b, c, a) * half_sine(c, a, b);
}

// Positions of nodes by id. Triangles are given by the ids of their corners, counter-clockwise.
using Places = std::map<std::int64_t, pnpbs::Point<2>>;
inline Places places_by_id(const pnpbs::Level<2>& level) {
  Places places;
  for (std::int64_t i = 0; i < level.nodes.count; ++i)
    places[level.nodes.id(i)] = level.nodes.position(i);
  return places;
}

inline std::vector<Triangle> triangles_by_id(const pnpbs::Level<2>& level) {
  std::vector<Triangle> triangles;
  for (std::int64_t i = 0; i < level.nodes.count; ++i)
    level.stars.for_simplices(i, [&](const pnpbs::DelaunayStars::Corners& others) {
      const std::int64_t j = others[0], k = others[1];
      if (i < j && i < k)
        triangles.push_back({level.nodes.id(i), level.nodes.id(j), level.nodes.id(k)});
    });
  return triangles;
}

inline double quality_of(const Triangle& t, const Places& places) {
  return quality(places.at(t[0]), places.at(t[1]), places.at(t[2]));
}

// Returns a fill in which every node is displaced at random by up to 0.4 d.
inline LevelRun distorted(const Build& build, const Plane& d, std::uint64_t seed,
                          const std::function<void(pnpbs::Settings&)>& adapt) {
  LevelRun fill(build, d);
  fill_level(*fill.level);
  pnpbs::IncomingNodes<2> nodes = inner_nodes_of(*fill.level);
  Random random(seed);
  for (pnpbs::IncomingNode<2>& node : nodes)
    for (double& x : node.position)
      x += random.between(-0.4, 0.4) * d(node.position[0], node.position[1]);
  LevelRun run(build, d, {}, adapt);
  pnpbs::take(*run.level, nodes, 0);
  run.renew_stars();
  return run;
}

struct Shape {
  Build build;
  Plane d;
};

inline std::vector<Shape> shapes_to_finish() {
  const Build square = [](pnpbs::PlaneDomain& p) {
    shapes::add_loop(p, shapes::rectangle(0, 0, 1, 1));
  };
  const Build slit = [square](pnpbs::PlaneDomain& p) {
    square(p);
    shapes::add_chain(p, {0.2, 0.5, 0.6, 0.53, 0.62, 0.8});
  };
  const Build lake = [](pnpbs::PlaneDomain& p) { add_lake(p, "lake_victoria"); };
  return {{square, constant(0.03)},
          {slit, [](double x, double y) { return 0.01 + 0.05 * std::hypot(x, y); }},
          {lake, [](double x, double y) { return 2 + 0.03 * std::hypot(x, y); }}};
}
