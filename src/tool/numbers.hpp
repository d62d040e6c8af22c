// SPDX-License-Identifier: BSD-3-Clause
// Conversion between numbers and texts for users.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/point_text.hpp"
#include "sphere/degrees.hpp"

namespace pnpbs::tool {

std::string grouped(std::int64_t count);                 // 103 214
std::string short_number(double value, int digits = 3);  // significant digits
std::string measure(double value);                       // four digits: 118 742, 0.01234
std::string size_in_bytes(double bytes);                 // 131 MiB
std::string duration(double seconds);                    // 0.94 s, 12 s, 3 min 20 s, 2 h 5 min

// Parses "1, 2.5,-3e4". Returns nothing if one of them is not a finite number.
std::optional<std::vector<double>> numbers_between_commas(const std::string& text);

// Returns the coordinates of a point with all digits, or its longitude and latitude in degrees if
// it is on a sphere.
inline std::string place_text(const double* x, int dimension, bool on_sphere = false) {
  if (dimension == 2) return point_text(Point<2>{x[0], x[1]}).text();
  const Point<3> place{x[0], x[1], x[2]};
  return on_sphere ? "(" + degrees_text(degrees_of(place)) + ")" : point_text(place).text();
}

}  // namespace pnpbs::tool
