// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/closing_disc.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "placement/placement_impl.hpp"

namespace pnpbs {

std::vector<Point<3>> nodes_around(const StereographicChart& other, const Spacing<2>& spacing,
                                   double radius) {
  auto disc = std::make_shared<PlaneDomain>(other);
  disc->add_arc(CurveRole::boundary, {0, 0}, 2 * other.radius() * std::tan(radius / 2), 0,
                2 * std::numbers::pi, 1);
  PlacementImpl<2> placement(serial_communicator(), disc, Options());
  // The spacing outlives the placement, so the pointer does not own it.
  placement.set_spacing(std::shared_ptr<const Spacing<2>>(&spacing, [](const Spacing<2>*) {}));
  if (placement.run() == Outcome::stopped)
    throw Error(ErrorKind::state, "the nodes that close the sphere were not placed");
  Results<2>& results = placement.results();
  results.prepare_stars();
  const auto place = [&](std::int64_t p) {
    return results.level().nodes.position(results.node_at(p));
  };
  std::array<std::int64_t, 3> next_to_point{};
  double least = std::numeric_limits<double>::infinity();
  results.for_elements([&](const std::array<std::int64_t, 3>& places) {
    double x = 0, y = 0;
    for (const std::int64_t p : places) {
      x += place(p)[0] / 3;
      y += place(p)[1] / 3;
    }
    if (x * x + y * y >= least) return;
    least = x * x + y * y;
    next_to_point = places;
  });
  std::vector<Point<3>> nodes;
  for (const std::int64_t p : next_to_point) nodes.push_back(other.on_sphere(place(p)));
  for (std::int64_t p = 0; p < results.count(); ++p)
    if (std::ranges::find(next_to_point, p) == next_to_point.end())
      nodes.push_back(other.on_sphere(place(p)));
  return nodes;
}

}  // namespace pnpbs
