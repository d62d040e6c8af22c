// SPDX-License-Identifier: BSD-3-Clause
//
// Domains in the plane: stars, combs, channels narrower than d, slits, holes, inner curves and
// fixed nodes.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "body.hpp"

namespace hunt {

namespace {

using std::numbers::pi;
using Flat = std::array<double, 2>;

std::vector<Flat> star(Random& random, const Flat& centre, double radius, double roughness) {
  const int corners = random.pick(3, 40);
  std::vector<Flat> points;
  for (int k = 0; k < corners; ++k) {
    const double away = radius * (1 - roughness * random.unit());
    points.push_back({centre[0] + away * std::cos(2 * pi * k / corners),
                      centre[1] + away * std::sin(2 * pi * k / corners)});
  }
  return points;
}

// Returns a strip of constant width along a wave.
std::vector<Flat> channel(Random& random, double width, double along) {
  const double waves = random.between(0.3, 3);
  const double height = std::min(random.between(0, 0.2) * along, 0.02 * along * along / waves);
  std::vector<Flat> points, back;
  const int pieces = random.pick(8, 60);
  for (int k = 0; k <= pieces; ++k) {
    const double t = 2 * pi * waves * k / pieces, x = along * k / pieces;
    const double slope = height * 2 * pi * waves / along * std::cos(t);
    const double to_side = width / 2 / std::hypot(1, slope);
    const double y = height * std::sin(t);
    points.push_back({x + slope * to_side, y - to_side});
    back.push_back({x - slope * to_side, y + to_side});
  }
  points.insert(points.end(), back.rbegin(), back.rend());
  return points;
}

void add_inside(Random& random, Body& body, double radius) {
  const int holes = random.pick(0, 3);
  for (int k = 0; k < holes; ++k) {
    // Holes lie side by side in a row.
    const Flat centre{radius * (-0.45 + 0.3 * k), radius * random.between(-0.1, 0.1)};
    Curve curve;
    const int kind = random.pick(0, 3);
    if (kind == 0) {
      curve.points = star(random, centre, radius * random.scale(0.02, 0.13), 0.6);
    } else if (kind == 1) {  // a slit
      const double half = radius * random.between(0.03, 0.13), thick = random.scale(0.02, 0.6);
      curve.points = {{centre[0] - half, centre[1]},
                      {centre[0], centre[1] - thick / 2},
                      {centre[0] + half, centre[1]},
                      {centre[0], centre[1] + thick / 2}};
    } else {
      curve.role = PNPBS_INNER;
      curve.closed = kind == 2;
      curve.points = star(random, centre, radius * random.scale(0.03, 0.13), 0.5);
    }
    curve.corner_angle = random.chance(0.5) ? 40 : 0;
    body.curves.push_back(curve);
  }
  if (random.chance(0.3))
    body.fixed.push_back({radius * random.between(-0.2, 0.2), radius * 0.35, 0});
}

}  // namespace

Body random_plane_body(Random& random, double nodes) {
  Body body;
  body.dim = 2;
  const int kind = random.pick(0, 3);
  Curve curve;
  curve.corner_angle = random.chance(0.5) ? random.between(10, 60) : 0;
  if (kind < 2) {
    const double roughness = random.chance(0.5) ? random.between(0, 0.2) : random.between(0.2, 0.8);
    const double radius = std::sqrt(0.87 * nodes / pi) / (1 - roughness / 2);
    body.name = "plane/star";
    curve.points = star(random, {0, 0}, radius, roughness);
    body.curves.push_back(curve);
    if (roughness < 0.2) add_inside(random, body, radius * 0.7);
    return body;
  }
  const double width = random.scale(0.2, 4);
  if (kind == 2) {
    body.name = "plane/channel";
    curve.points = channel(random, width, std::max(6.0, 0.8 * nodes / (2 + 1.15 * width)));
  } else {
    std::string name;
    curve.points = random_outline(random, width, name);
    body.name = "plane/" + name;
    const double factor = random.scale(1, 12);
    for (auto& [x, y] : curve.points) x *= factor;
  }
  body.curves.push_back(curve);
  return body;
}

}  // namespace hunt
