// SPDX-License-Identifier: BSD-3-Clause
#include "tool/body_figures.hpp"

#include <cmath>
#include <numeric>
#include <vector>

#include "base/space_vectors.hpp"
#include "tool/own_elements.hpp"

namespace pnpbs::tool {
namespace {

// By local indices: this rank's nodes, then its ghosts.
std::vector<Point<3>> positions_seen(pnpbs_placement placement, pnpbs_context context) {
  std::int64_t own = 0, ghosts = 0;
  check(pnpbs_placement_count(placement, &own), context);
  check(pnpbs_placement_ghost_count(placement, &ghosts), context);
  // One more than there are, so that there is a first one.
  std::vector<Point<3>> positions(static_cast<std::size_t>(own + ghosts + 1));
  check(pnpbs_placement_get_nodes(placement, own, positions[0].data(), nullptr, nullptr, nullptr),
        context);
  check(
      pnpbs_placement_get_ghosts(placement, ghosts, positions[static_cast<std::size_t>(own)].data(),
                                 nullptr, nullptr, nullptr, nullptr),
      context);
  return positions;
}

}  // namespace

BodyFigures body_figures(pnpbs_domain domain, bool filled, pnpbs_context context) {
  Box<3> box{};
  BodyFigures figures{};
  check(pnpbs_domain_bounds(domain, box.low.data(), box.high.data()), context);
  double measure = 0;
  check(pnpbs_domain_measure(domain, &measure), context);
  if (filled)
    figures.volume = measure;
  else
    figures.area = measure;
  figures.extent = difference(box.high, box.low);
  return figures;
}

double boundary_area(pnpbs_placement placement, pnpbs_context context, const Ranks& ranks) {
  const std::vector<Point<3>> x = positions_seen(placement, context);
  const auto at = [&x](std::int64_t node) { return x[static_cast<std::size_t>(node)]; };
  double area = 0;
  for (const auto& [a, b, c] : own_boundary(placement, context)) {
    const Point<3> normal = cross(difference(at(b), at(a)), difference(at(c), at(a)));
    area += 0.5 * std::sqrt(dot(normal, normal));
  }
  const std::vector<double> areas = ranks.gather(std::vector<double>{area});
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

}  // namespace pnpbs::tool
