// SPDX-License-Identifier: BSD-3-Clause
#include "geo/legs.hpp"

#include <algorithm>
#include <cmath>

#include "base/space_vectors.hpp"
#include "sphere/degrees.hpp"

namespace pnpbs::geo {
namespace {

bool is_pole(const Point<2>& degrees) { return std::fabs(degrees[1]) == 90; }

}  // namespace

Legs Legs::shortest(const Point<2>& a, const Point<2>& b) {
  const double first = is_pole(a) ? b[0] : a[0], last = is_pole(b) ? a[0] : b[0];
  const double across = last - first, sum = a[1] + b[1];
  // As near to opposite meridians as canonical places can be told apart.
  constexpr double kSame = 1e-9;
  const bool is_over_pole = std::fabs(std::fabs(across) - 180) < kSame && sum != 0;
  if (is_over_pole) {
    const double pole = std::copysign(90, sum);
    return Legs({{{a, {a[0], pole}}, {{b[0], pole}, b}}}, 2);
  }
  if (std::fabs(across) <= 180) return straight({first, a[1]}, {last, b[1]});
  const double turn = std::copysign(360, across);
  return Legs({{{a, {last - turn, b[1]}}, {{first + turn, a[1]}, b}}}, 2);
}

Point<2> Legs::middle() const {
  const auto& [from, to] = legs_[0];
  const bool is_over_pole = count_ == 2 && is_pole(to);
  return is_over_pole ? to : middle_of<2>(from, to);
}

double off_great_circle(const Point<2>& place, const Point<2>& a, const Point<2>& b) {
  const Point<3> here = direction_at(place), from = direction_at(a), to = direction_at(b);
  const Point<3> normal = unit_vector(cross(from, to));
  const double near = std::min(distance<3>(here, from), distance<3>(here, to));
  return near > 0 ? std::fabs(dot(here, normal)) / near : 0;
}

}  // namespace pnpbs::geo
