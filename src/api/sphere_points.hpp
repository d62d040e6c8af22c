// SPDX-License-Identifier: BSD-3-Clause
// Points of a sphere: conversion between the space coordinates of the C interface and the chart in
// which the library places nodes.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "api/guard.hpp"
#include "base/point_text.hpp"
#include "base/space_vectors.hpp"
#include "sphere/embedding.hpp"

namespace pnpbs::api {

// Returns the point. Throws if it has no direction from the centre of the sphere.
inline Point<3> require_direction(const std::string& argument, const double* x) {
  const Point<3> point{x[0], x[1], x[2]};
  const double square = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
  if (!(square > 0) || !(square < 1e120))
    throw Error(ErrorKind::argument, "argument " + argument + " = " + point_text(point) +
                                         " has no direction from the centre of the sphere");
  return point;
}

inline std::vector<Point<3>> require_directions(const char* argument, std::int64_t n,
                                                const double* coordinates) {
  require_count(n, "n");
  if (n > 0) require_pointer(coordinates, argument);
  std::vector<Point<3>> points;
  for (std::int64_t i = 0; i < n; ++i)
    points.push_back(require_direction(std::string(argument) + "[" + std::to_string(i) + "]",
                                       coordinates + 3 * i));
  return points;
}

// Returns the coordinates in which nodes are placed: the given ones, or on a sphere those of the
// chart, which are written to `charted`. The projection point itself has none in the chart and
// becomes a point very far away.
inline const double* placed_coordinates(const Embedding<2>& embedding, std::int64_t n,
                                        const double* coordinates, std::vector<double>& charted) {
  if (!embedding.is_sphere()) return coordinates;
  for (const Point<3>& x : require_directions("coordinates", n, coordinates)) {
    constexpr double kFarOut = 1e9;
    Point<2> u = embedding.chart().in_chart(x);
    if (!std::isfinite(u[0]) || !std::isfinite(u[1])) u = {kFarOut * embedding.radius(), 0};
    charted.insert(charted.end(), u.begin(), u.end());
  }
  return charted.data();
}
inline const double* placed_coordinates(const Embedding<3>&, std::int64_t,
                                        const double* coordinates, std::vector<double>&) {
  return coordinates;
}

// Returns the coordinates of the points projected to the sphere.
inline std::vector<double> put_on_sphere(double radius, const std::vector<Point<3>>& points) {
  std::vector<double> coordinates;
  for (const Point<3>& x : points)
    for (const double part : unit_vector(x)) coordinates.push_back(radius * part);
  return coordinates;
}

// Throws if the object is on a sphere, where `what` is not supported yet.
inline void require_no_sphere(const Embedding<2>& embedding, const char* argument,
                              const char* what) {
  if (embedding.is_sphere())
    throw Error(ErrorKind::argument, std::string("argument ") + argument + " is on a sphere: " +
                                         what + " in the plane and in space only");
}

}  // namespace pnpbs::api
