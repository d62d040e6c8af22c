// SPDX-License-Identifier: BSD-3-Clause
//
// Rough scans: triangulated spheres, elongated and bent with bumps, with noise at every vertex.
// They are star-shaped and therefore never cross themselves.
#include <cmath>
#include <map>

#include "body.hpp"

namespace hunt {

namespace {

Mesh octahedron() {
  Mesh mesh;
  mesh.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return mesh;
}

Mesh icosahedron() {
  const double g = (1 + std::sqrt(5.0)) / 2;
  Mesh mesh;
  mesh.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                 {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  return mesh;
}

}  // namespace

Body random_scan(Random& random, double nodes) {
  Body body;
  body.name = "scan";
  Mesh mesh = random.chance(0.6) ? icosahedron() : octahedron();
  refine(mesh, random.pick(2, 4));
  const double noise = random.scale(0.005, 0.05);
  double bump[3][3], phase[3];
  for (int k = 0; k < 3; ++k) {
    for (double& part : bump[k]) part = random.between(-4, 4);
    phase[k] = random.between(0, 6.3);
  }
  const double height = random.chance(0.6) ? random.between(0, 0.25) : 0;
  const Point axes{1, random.scale(0.15, 1), random.scale(0.1, 1)};
  for (Point& point : mesh.points) {
    point = unit(point);
    double radius = 1 + noise * random.between(-1, 1);
    for (int k = 0; k < 3; ++k)
      radius += height / 1.5 *
                std::sin(bump[k][0] * point[0] + bump[k][1] * point[1] + bump[k][2] * point[2] +
                         phase[k]);
    for (int k = 0; k < 3; ++k) point[k] *= radius * axes[k];
  }
  scale_to(mesh, nodes);
  body.meshes.push_back(std::move(mesh));
  return body;
}

}  // namespace hunt
