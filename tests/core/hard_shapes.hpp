// SPDX-License-Identifier: BSD-3-Clause
// Domains that are difficult for adjacency lists and triangles, each with a suitable spacing.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "level_run.hpp"

namespace hard_shapes {

using pnpbs::PlaneDomain;
using shapes::add_chain;
using shapes::add_circle;
using shapes::add_loop;
using shapes::rectangle;

inline void add_square(PlaneDomain& domain) { add_loop(domain, rectangle(0, 0, 1, 1)); }

inline void add_annulus(PlaneDomain& domain) {
  add_circle(domain, 0.5, 0.5, 0.5);
  add_circle(domain, 0.45, 0.52, 0.17);
}

inline void add_square_with_slit(PlaneDomain& domain) {
  add_square(domain);
  add_chain(domain, {0.2, 0.51, 0.7, 0.55, 0.72, 0.8});
}

inline void add_square_cut_in_two(PlaneDomain& domain) {
  add_square(domain);
  add_chain(domain, {0, 0.4, 0.6, 0.47, 1, 0.9});
  const double fixed[] = {0.3, 0.2, 0.8, 0.3};
  domain.add_fixed_nodes(2, fixed, nullptr);
}

inline void add_square_with_islet(PlaneDomain& domain) {
  add_square(domain);
  add_loop(domain, shapes::circle(0.503, 0.498, 0.004, 5));
  add_loop(domain, shapes::circle(0.2, 0.25, 0.0001, 4));
}

// Adds a comb with channels of width 0.02 between teeth of the same width.
inline void add_comb(PlaneDomain& domain) {
  std::vector<double> xy{0, 0, 1, 0};
  for (double x = 0.98; x > 0.1; x -= 0.04)
    for (const auto& [dx, y] :
         {std::pair{0.0, 0.5}, std::pair{0.0, 0.1}, std::pair{-0.02, 0.1}, std::pair{-0.02, 0.5}})
      xy.insert(xy.end(), {x + dx, y});
  xy.insert(xy.end(), {0, 0.5});
  domain.add_polyline(pnpbs::CurveRole::boundary, true, static_cast<std::int64_t>(xy.size() / 2),
                      xy.data(), nullptr, 0);
}

// Adds a polygon with corners of 1 degree (at the origin) and 5 degrees (at (0, 0.7)).
inline void add_thorns(PlaneDomain& domain) {
  const auto slope = [](double degrees) { return std::tan(degrees * shapes::pi / 180); };
  const double tilt = std::atan2(0.1, 0.9) * 180 / shapes::pi;
  const std::vector<double> xy{0, 0,   1,   0,   1.5, 0.3,           1, 0.7 - slope(tilt - 5),
                               0, 0.7, 0.9, 0.6, 0.9, 0.9 * slope(1)};
  domain.add_polyline(pnpbs::CurveRole::boundary, true, static_cast<std::int64_t>(xy.size() / 2),
                      xy.data(), nullptr, 0);
}

struct Shape {
  const char* name;
  Build build;
  double d;
};

inline const std::vector<Shape>& small_shapes() {
  static const std::vector<Shape> all{{"square", add_square, 0.03},
                                      {"annulus", add_annulus, 0.03},
                                      {"square with a slit", add_square_with_slit, 0.03},
                                      {"square cut in two", add_square_cut_in_two, 0.035},
                                      {"square with islets", add_square_with_islet, 0.03},
                                      {"comb", add_comb, 0.015},
                                      {"thorns", add_thorns, 0.03}};
  return all;
}

inline Plane graded(double d) {
  return [d](double x, double y) { return d * (0.4 + 2 * std::hypot(x - 0.4, y - 0.3)); };
}

// A spacing that jumps by a factor of 12.
inline Plane jump(double d) {
  return [d](double x, double y) { return x + 0.3 * y < 0.55 ? d / 3 : 4 * d; };
}

}  // namespace hard_shapes
