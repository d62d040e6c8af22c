// SPDX-License-Identifier: BSD-3-Clause
#include "geo/grid_slopes.hpp"

#include "sphere/slopes.hpp"

namespace pnpbs::geo {

void evaluate_slopes(const Grid& grid, double radius, const std::vector<Point<2>>& points,
                     double* slopes) {
  const auto count = static_cast<std::int64_t>(points.size());
  if (count == 0) return;
  const auto of_plane = [&](std::int64_t n, const double* coordinates, double* values) {
    std::vector<Point<2>> places(static_cast<std::size_t>(n));
    for (std::size_t i = 0; i < places.size(); ++i)
      places[i] = {coordinates[2 * i], coordinates[2 * i + 1]};
    grid.evaluate(places, values, nullptr);
  };
  if (radius == 0) {
    const Box<2>& box = grid.extent();
    const double side =
        longest_finite_side({{box.low[0], box.low[1], 0}, {box.high[0], box.high[1], 0}});
    slopes_of(of_plane, 2, false, side, count, points[0].data(), slopes);
    return;
  }
  const auto of_sphere = [&](std::int64_t n, const double* coordinates, double* values) {
    std::vector<Point<2>> places(static_cast<std::size_t>(n));
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double* x = coordinates + 3 * i;
      places[i] = degrees_of({x[0], x[1], x[2]});
    }
    grid.evaluate(places, values, nullptr);
  };
  std::vector<double> on_sphere;
  for (const Point<2>& degrees : points)
    for (const double coordinate : direction_at(degrees)) on_sphere.push_back(radius * coordinate);
  slopes_of(of_sphere, 3, true, 0, count, on_sphere.data(), slopes);
}

}  // namespace pnpbs::geo
