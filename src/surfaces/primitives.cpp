// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces/primitives.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "base/space_vectors.hpp"

namespace pnpbs {

namespace {

constexpr int kCuts = 6;
constexpr std::int32_t kStrips = 256;

using Corners = std::array<std::int32_t, 3>;

// Points on the unit sphere, and triangles between them.
struct UnitSphere {
  std::vector<Point<3>> points;
  std::vector<Corners> triangles;
};

UnitSphere icosahedron() {
  constexpr double g = std::numbers::phi;
  UnitSphere sphere{
      {{-1, g, 0},
       {1, g, 0},
       {-1, -g, 0},
       {1, -g, 0},
       {0, -1, g},
       {0, 1, g},
       {0, -1, -g},
       {0, 1, -g},
       {g, 0, -1},
       {g, 0, 1},
       {-g, 0, -1},
       {-g, 0, 1}},
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (Point<3>& x : sphere.points) x = unit_vector(x);
  return sphere;
}

// Divides each triangle into four.
void cut(UnitSphere& sphere) {
  std::unordered_map<std::int64_t, std::int32_t> middles;
  const auto middle = [&](std::int32_t a, std::int32_t b) {
    const std::int64_t edge = (std::int64_t{std::min(a, b)} << 32) + std::max(a, b);
    const auto [entry, is_new] =
        middles.try_emplace(edge, static_cast<std::int32_t>(sphere.points.size()));
    if (is_new)
      sphere.points.push_back(unit_vector(shifted(sphere.points[a], 1, sphere.points[b])));
    return entry->second;
  };
  std::vector<Corners> finer;
  finer.reserve(4 * sphere.triangles.size());
  for (const auto& [a, b, c] : sphere.triangles) {
    const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Corners& piece : {Corners{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
      finer.push_back(piece);
  }
  sphere.triangles = std::move(finer);
}

}  // namespace

SurfaceSource box_surface(const Point<3>& low, const Point<3>& high,
                          const std::array<std::int32_t, 6>& tags) {
  SurfaceSource box;
  for (int corner = 0; corner < 8; ++corner)
    box.vertices.push_back({(corner & 1) != 0 ? high[0] : low[0],
                            (corner & 2) != 0 ? high[1] : low[1],
                            (corner & 4) != 0 ? high[2] : low[2]});
  constexpr std::array<std::array<std::int32_t, 4>, 6> sides{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (std::size_t side = 0; side < sides.size(); ++side) {
    const auto& [a, b, c, d] = sides[side];
    box.triangles.push_back({a, b, c});
    box.triangles.push_back({a, c, d});
    box.tags.insert(box.tags.end(), 2, tags[side]);
  }
  return box;
}

SurfaceSource ball_surface(const Point<3>& centre, double radius, std::int32_t tag) {
  UnitSphere sphere = icosahedron();
  for (int times = 0; times < kCuts; ++times) cut(sphere);
  SurfaceSource ball;
  ball.approximates = ball.is_ball = true;
  for (const Point<3>& x : sphere.points) ball.vertices.push_back(shifted(centre, radius, x));
  ball.triangles = std::move(sphere.triangles);
  ball.tags.assign(ball.triangles.size(), tag);
  return ball;
}

// The four triangles that divide one are consecutive, and the vertices of coarser triangles come
// first.
SurfaceSource coarser_ball(SurfaceSource ball) {
  std::vector<Corners> coarser;
  for (std::size_t t = 0; t + 3 < ball.triangles.size(); t += 4)
    coarser.push_back({ball.triangles[t][0], ball.triangles[t + 1][1], ball.triangles[t + 2][2]});
  ball.triangles = std::move(coarser);
  ball.tags.resize(ball.triangles.size());
  ball.vertices.resize(ball.triangles.size() / 2 + 2);
  return ball;
}

SurfaceSource cylinder_surface(const Point<3>& begin, const Point<3>& end, double radius,
                               std::int32_t tag) {
  const Point<3> axis = unit_vector(difference(end, begin));
  Point<3> across{};  // the coordinate axis that is least parallel to the cylinder
  const auto least = std::min_element(
      axis.begin(), axis.end(), [](double a, double b) { return std::fabs(a) < std::fabs(b); });
  across[static_cast<std::size_t>(least - axis.begin())] = 1;
  const Point<3> u = unit_vector(cross(axis, across)), v = cross(axis, u);
  SurfaceSource cylinder;
  cylinder.approximates = true;
  for (const Point<3>& centre : {begin, end}) {
    for (std::int32_t i = 0; i < kStrips; ++i) {
      const double angle = 2 * std::numbers::pi * i / kStrips;
      cylinder.vertices.push_back(
          shifted(shifted(centre, radius * std::cos(angle), u), radius * std::sin(angle), v));
    }
    cylinder.vertices.push_back(centre);
  }
  constexpr std::int32_t low = kStrips, top = kStrips + 1, high = 2 * kStrips + 1;
  for (std::int32_t i = 0; i < kStrips; ++i) {
    const std::int32_t next = (i + 1) % kStrips;
    for (const Corners& triangle : {Corners{i, next, top + next},
                                    {i, top + next, top + i},
                                    {low, next, i},
                                    {high, top + i, top + next}})
      cylinder.triangles.push_back(triangle);
  }
  cylinder.tags.assign(cylinder.triangles.size(), tag);
  return cylinder;
}

}  // namespace pnpbs
