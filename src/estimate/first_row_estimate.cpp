// SPDX-License-Identifier: BSD-3-Clause
#include "estimate/first_row_estimate.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

#include "geometry/plane/incident_sectors.hpp"
#include "quality/plane/boundary_apexes.hpp"

namespace pnpbs {

namespace {

// Ratio of the excess of nodes per edge to the excess 1 - edge length / d with d at the apex.
// Without a fitted row, the first row of bubbles is farther from the boundary than the apexes, and
// d is larger there. Fitted to runs in a ring, in a lake and around an airfoil with d growing by
// 0.15 to 0.3.
constexpr double kOverGrowth = 1.5;

std::vector<double> values_at(const std::vector<Point<2>>& points,
                              const SpacingEvaluator<2>& spacing) {
  std::vector<double> d(points.size());
  spacing(std::ssize(points), points.data(), d.data());
  return d;
}

}  // namespace

double first_row_excess(const SizedTree<2>& map, const SpacingEvaluator<2>& spacing,
                        std::int64_t max_edges) {
  const BoundaryMesh<2>& boundary = map.boundary();
  IncidentSectors sectors;
  sectors.build(boundary);
  std::vector<Point<2>> ends, places;
  for (const BoundaryNode<2>& node : boundary.nodes) ends.push_back(node.position);
  const std::vector<double> at_ends = values_at(ends, spacing);
  const auto edges = static_cast<std::int64_t>(boundary.facets.size());
  const std::int64_t stride =
      std::max<std::int64_t>(1, edges / std::max<std::int64_t>(1, max_edges));
  std::vector<std::int32_t> some;
  for (std::int64_t e = 0; e < edges; e += stride) some.push_back(static_cast<std::int32_t>(e));
  const BoundaryApexes apexes(
      map, sectors, [&](std::int32_t b) { return at_ends[static_cast<std::size_t>(b)]; }, some);
  std::vector<double> lengths;
  for (const BoundaryApex& apex : apexes.all()) {
    if (!apex.stands) continue;
    places.push_back(apex.place);
    lengths.push_back(apex.edge_length);
  }
  const std::vector<double> at_places = values_at(places, spacing);
  double more = 0;
  for (std::size_t k = 0; k < places.size(); ++k)
    more += kOverGrowth * (1 - lengths[k] / at_places[k]);
  return more * static_cast<double>(edges) /
         static_cast<double>(std::max<std::size_t>(1, some.size()));
}

}  // namespace pnpbs
