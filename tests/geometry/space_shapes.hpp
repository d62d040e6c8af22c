// SPDX-License-Identifier: BSD-3-Clause
// Surfaces as meshes with tags, for tests of nodes and walks on surfaces.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "base/space_vectors.hpp"
#include "core/surfaces.hpp"
#include "domain/spacing_evaluator.hpp"
#include "geometry/boundary_mesh.hpp"
#include "surfaces/triangulation.hpp"

namespace space_shapes {

inline constexpr double pi = std::numbers::pi;
using Mesh = pnpbs::BoundaryMesh<3>;
using P = pnpbs::Point<3>;

struct Shape {
  std::vector<P> nodes;
  std::vector<std::array<std::int32_t, 3>> triangles;

  std::int32_t node(const P& x) {
    nodes.push_back(x);
    return static_cast<std::int32_t>(nodes.size()) - 1;
  }
  P centroid(std::size_t t) const {
    P sum{};
    for (const std::int32_t corner : triangles[t])
      sum = pnpbs::shifted(sum, 1.0 / 3, nodes[static_cast<std::size_t>(corner)]);
    return sum;
  }
  Mesh mesh(const std::function<std::int32_t(const P& centroid)>& tag_at) const {
    Mesh mesh;
    std::vector<std::int32_t> tags;
    for (std::size_t t = 0; t < triangles.size(); ++t) tags.push_back(tag_at(centroid(t)));
    pnpbs::add_surface(mesh, pnpbs::SurfaceRole::boundary, nodes, triangles, tags);
    return mesh;
  }
  Mesh mesh(std::int32_t tag = 1) const {
    return mesh([tag](const P&) { return tag; });
  }
};

inline Shape shape_of(const surfaces::Surface& surface) {
  Shape shape;
  for (const surfaces::Place& x : surface.nodes) shape.nodes.push_back(surface.at(x));
  shape.triangles = surface.triangles;
  return shape;
}

// Returns a ball of radius 1. Its coordinates are integers in a fine unit.
inline Shape ball(int cuts) {
  constexpr std::int64_t kFine = 6 << 24;
  surfaces::Surface surface = surfaces::sphere(cuts, kFine);
  surface.unit = 1.0 / kFine;
  return shape_of(surface);
}

inline Shape cube(std::int64_t n) {
  surfaces::Surface surface =
      surfaces::cubes(n, [](std::int64_t, std::int64_t, std::int64_t) { return true; });
  surface.unit = 1.0 / static_cast<double>(6 * n);
  return shape_of(surface);
}

// Returns a rectangle in the plane z = 0 with n by m squares.
inline Shape sheet(int n, int m, double width, double height) {
  Shape shape;
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= n; ++i) shape.node({width * i / n, height * j / m, 0});
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      const std::int32_t a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      if ((i + j) % 2 == 0) {
        shape.triangles.push_back({a, b, c});
        shape.triangles.push_back({a, c, d});
      } else {
        shape.triangles.push_back({a, b, d});
        shape.triangles.push_back({b, c, d});
      }
    }
  return shape;
}

// Returns a cylinder of radius 1 about the z axis, with n facets around and m along it.
inline Shape cylinder(int n, int m, double height) {
  Shape shape;
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * pi * (i + 0.5 * (j % 2)) / n;
      shape.node({std::cos(angle), std::sin(angle), height * j / m});
    }
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      const int shift = j % 2, next = (i + 1) % n;
      const std::int32_t a = j * n + i, b = j * n + next;
      const std::int32_t c = (j + 1) * n + i, d = (j + 1) * n + next;
      if (shift == 0) {
        shape.triangles.push_back({a, b, c});
        shape.triangles.push_back({b, d, c});
      } else {
        shape.triangles.push_back({a, b, d});
        shape.triangles.push_back({a, d, c});
      }
    }
  const std::int32_t bottom = shape.node({0, 0, 0}), top = shape.node({0, 0, height});
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    shape.triangles.push_back({bottom, next, i});
    shape.triangles.push_back({top, m * n + i, m * n + next});
  }
  return shape;
}

// Returns the shape rotated about an oblique axis.
inline Shape turned(Shape shape, double angle) {
  const P axis = pnpbs::unit_vector({1, 0.3, -0.7});
  for (P& x : shape.nodes) {
    const P along = pnpbs::shifted({}, pnpbs::dot(axis, x), axis);
    const P across = pnpbs::difference(x, along), side = pnpbs::cross(axis, across);
    x = pnpbs::shifted(pnpbs::shifted(along, std::cos(angle), across), std::sin(angle), side);
  }
  return shape;
}

inline pnpbs::SpacingEvaluator<3> evaluator_of(std::function<double(const P&)> d) {
  return [d = std::move(d)](std::int64_t n, const P* x, double* values) {
    for (std::int64_t i = 0; i < n; ++i) values[i] = d(x[i]);
  };
}

inline pnpbs::SpacingEvaluator<3> constant(double d) {
  return evaluator_of([d](const P&) { return d; });
}

}  // namespace space_shapes
