// SPDX-License-Identifier: BSD-3-Clause
// Checks of single arguments of the user. Each check throws Error(ErrorKind::argument) with the
// name of the argument and its value.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/limits.hpp"
#include "base/point_text.hpp"
#include "base/types.hpp"

namespace pnpbs::given_values {

[[noreturn]] void reject(const MessageText& message);

// Returns the name of an element of an array, such as "name[3]".
std::string indexed(const std::string& name, std::int64_t index);

void require_number(const std::string& name, double value);
void require_array(const char* name, const void* array, std::int64_t n);
void require_count(const char* name, std::int64_t value, std::int64_t min);
void require_tag(const std::string& name, std::int32_t tag);
void require_radius(double radius);
void require_angle(const char* name, double degrees);

template <int Dim>
void require_point(const std::string& name, const Point<Dim>& x) {
  for (int k = 0; k < Dim; ++k) require_number(indexed(name, k), x[k]);
}

// Throws Error(ErrorKind::argument), with index and value, at the first coordinate that is not a
// number between -1e60 and 1e60.
template <int Dim>
void require_points(const std::string& name, std::int64_t n, const double* coordinates) {
  for (std::int64_t i = 0; i < n; ++i) {
    Point<Dim> x;
    std::copy_n(coordinates + Dim * i, Dim, x.begin());
    if (!is_usable(x)) require_point<Dim>(indexed(name, i), x);
  }
}

// Returns n points from an array of Dim * n coordinates. Throws as require_points() does, and if
// the array is null.
template <int Dim>
std::vector<Point<Dim>> read_points(const char* name, std::int64_t n, const double* coordinates) {
  require_array(name, coordinates, n);
  std::vector<Point<Dim>> points(static_cast<std::size_t>(n));
  for (std::int64_t i = 0; i < n; ++i) {
    Point<Dim>& x = points[static_cast<std::size_t>(i)];
    for (int k = 0; k < Dim; ++k) x[k] = coordinates[Dim * i + k];
    if (!is_usable(x)) require_point<Dim>(indexed(name, i), x);
  }
  return points;
}

// Returns the n tags, or n times 1 if `tags` is null. Throws if a tag is 0.
std::vector<std::int32_t> read_tags(const char* name, std::int64_t n, const std::int32_t* tags);

// Throws if two consecutive vertices of a polyline coincide, since segments must have a length.
template <int Dim>
void require_distinct_neighbours(const std::vector<Point<Dim>>& points, bool closed) {
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (points[i] == points[i + 1]) {
      reject("vertices " + std::to_string(i) + " and " + std::to_string(i + 1) + " are both " +
             point_text(points[i]) + ": the segment between them has no length");
    }
  }
  if (closed && points.front() == points.back()) {
    reject("the first vertex of a closed curve is repeated as the last, vertex " +
           std::to_string(points.size() - 1) + " " + point_text(points.back()) + ": leave it out");
  }
}

}  // namespace pnpbs::given_values
