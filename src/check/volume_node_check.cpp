// SPDX-License-Identifier: BSD-3-Clause
#include "check/volume_node_check.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/limits.hpp"
#include "base/point_text.hpp"
#include "base/space_vectors.hpp"
#include "geometry/volume/triangle_samples.hpp"
#include "geometry/volume/triangles.hpp"

namespace pnpbs {

VolumeNodeCheck::VolumeNodeCheck(const Results<3>& results)
    : NodeCheck<3>(results), geometry_(level_.geometry) {
  for (const std::shared_ptr<const LevelSet>& set : geometry_.domain().level_sets().sets)
    if (set) resolution_ = std::max(resolution_, set->resolution());
}

std::array<Point<3>, 3> VolumeNodeCheck::positions_at(const Three& places) const {
  return {position(p_.node_at(places[0])), position(p_.node_at(places[1])),
          position(p_.node_at(places[2]))};
}

void VolumeNodeCheck::check_sides() const {
  for_owned([&](std::int64_t i) {
    if (is_feature_node(i))
      check_placed(i, laid(static_cast<std::size_t>(nodes_.boundary_node(i))));
    else if (nodes_.carrier(i) == Carrier::surface)
      check_on_surface(i);
    else
      check_inside(i, geometry_.domain().index().sides());
  });
}

// Returns the distance to the plane of the nearest facet if the foot point lies in the facet. On a
// needle, the distance to the foot point itself has a large rounding error.
double VolumeNodeCheck::gap_to_facet(const Point<3>& x) const {
  const SurfaceIndex& index = geometry_.domain().index();
  const NearestPoint<3> nearest = index.nearest(x, std::numeric_limits<double>::infinity());
  const FacetCorners<3> corners = geometry_.surface().corners(nearest.facet);
  const auto [v, w] = nearest_triangle_point(corners, x).along;
  const Point<3> normal =
      cross(difference(corners[1], corners[0]), difference(corners[2], corners[0]));
  if (!(v > 0 && w > 0 && v + w < 1)) return nearest.gap;
  return std::fabs(dot(normal, difference(x, nearest.x))) / std::sqrt(dot(normal, normal));
}

// Checks that the node is on its surface up to rounding. A node on a level set may be off its
// triangles by the resolution.
void VolumeNodeCheck::check_on_surface(std::int64_t i) const {
  const double gap = gap_to_facet(position(i));
  const LevelSet* set = geometry_.domain().level_sets().at(nodes_.boundary_node(i));
  if (gap > (set ? set->resolution() : 0) + 0x1p-44 * farthest_coordinate<3>(geometry_.bounds()))
    fail_check("node " + name(i) + " is on a surface, but " + rounded_text(gap) +
               " away from the next one");
}

void VolumeNodeCheck::check_feature_nodes() const {
  std::vector<std::int64_t> times(geometry_.features().nodes.size(), 0);
  for_owned([&](std::int64_t i) {
    if (is_feature_node(i)) ++times[static_cast<std::size_t>(nodes_.boundary_node(i))];
  });
  check_placed_once(
      std::move(times), [this](std::size_t n) { return laid(n); },
      [this](std::size_t n) {
        return !geometry_.feature_node_in_cell(static_cast<std::int32_t>(n));
      });
}

double VolumeNodeCheck::max_gap(const std::array<Point<3>, 3>& corners) const {
  double gap = 0;
  for (const Point<3>& x : triangle_samples(corners)) gap = std::max(gap, gap_to_surface(x));
  // Nodes of a level set lie on it, and thus off its triangles where these round its edges.
  if (resolution_ > 0)
    for (const Point<3>& corner : corners) gap = std::max(gap, gap_to_surface(corner));
  return gap;
}

}  // namespace pnpbs
