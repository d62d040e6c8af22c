// SPDX-License-Identifier: BSD-3-Clause
#include "run/measuring_finish.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "base/point_text.hpp"
#include "check/conformity.hpp"
#include "level/volume/inner_facets.hpp"
#include "method/constants.hpp"
#include "results/element_angles.hpp"
#include "sizing/holding_spacing.hpp"

namespace pnpbs {

template <int Dim>
void gather_unknown_uses(const Level<Dim>& level, RunState& run) {
  run.unknown_uses = static_cast<std::int64_t>(level.comm->allreduce_sum(
      static_cast<std::uint64_t>(run.unknown_uses_before + level.unknown_uses)));
  if (run.unknown_uses > 0)
    run.warnings.emplace_back(
        WarningCode::depends_on_ranks,
        "the nodes may depend on the number of ranks: " + std::to_string(run.unknown_uses) +
            " decisions used data that their rank does not hold exactly (statistic "
            "unknown_uses); on one rank there are none",
        run.unknown_uses);
}

void measure_finish(Results<2>&, const PlacedSpacing<2>&, RunState&) {}

void measure_finish(Results<3>& results, const PlacedSpacing<3>& placed, RunState& run) {
  const Level<3>& level = results.level();
  const PhaseTimer timer(level.timers, Phase::conformity);
  results.prepare_stars();
  const View<char> held = held_nodes(level, placed);  // d is not the user's at these nodes
  collective_try(*level.comm, [&] {
    run.edge_bands = edge_bands_to_judge<3>(*level.comm, {level.nodes}, level.stars, held);
  });
  run.surface_fit = measure_surface_fit(level);
}

namespace {

// Warns of small angles in elements that conform. If the option min_angle is set, their corners
// become the points where d is reduced next.
void find_small_angles(const Level<3>& level, RunState& run, Unresolved<3>& unresolved) {
  if (level.geometry.kind() == GeometryKind::surface) return;
  const double min_angle = level.settings.min_angle,
               below = min_angle > 0 ? min_angle : method::kSmallAngle;
  SmallAngleElements found = small_angle_elements(level, below);
  if (found.all.count == 0) return;
  run.warnings.emplace_back(
      WarningCode::small_angles,
      "dihedral angles below " + number_text(below) +
          " degrees: " + std::to_string(found.all.count) + " tetrahedra, one of them at " +
          rounded_point_text<3>(found.all.at) +
          ", where the body has walls, gaps or steps much smaller than the spacing: make it "
          "smaller there" +
          (min_angle > 0 ? "" : ", or set the option min_angle"),
      found.all.count, below);
  if (min_angle == 0) return;
  unresolved.small_angles = found.all.count;
  unresolved.places = std::move(found.places);
}

// Returns the corners of faces of this rank where tetrahedra cross inner surfaces. If no rank has
// any, returns the corners of the faces around the regions that do not have their volumes. All
// ranks must call it, and if one rank throws, all ranks throw.
std::vector<Point<3>> points_of_crossed_surfaces(const Level<3>& level,
                                                 const Conformity<3>& conformity) {
  std::vector<Point<3>> points;
  collective_try(*level.comm, [&] {
    InnerFacets facets(level);
    for (std::int64_t i = 0; i < level.nodes.count; ++i)
      if (level.nodes.owned(i))
        for (const InnerFacet& stray : facets.strays_at(i))
          for (const std::int64_t j : stray.nodes) points.push_back(level.nodes.position(j));
  });
  const bool any_crossed = level.comm->allreduce_sum(points.size()) > 0;
  collective_try(*level.comm, [&] {
    if (!any_crossed)
      for (const RegionMeasure& region : conformity.regions)
        points.insert(points.end(), region.corners.begin(), region.corners.end());
  });
  std::ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

}  // namespace

bool elements_cross_inner_surfaces(Results<2>&) { return false; }

bool elements_cross_inner_surfaces(Results<3>& results) {
  if (!results.level().geometry.has_inner_surfaces()) return false;
  const PhaseTimer timer(results.level().timers, Phase::conformity);
  results.prepare_stars();
  bool crosses = false;
  collective_try(results.communicator(), [&] { crosses = crosses_inner_surfaces(results); });
  return crosses;
}

// Triangles of the plane always conform, because their stars are constrained to the boundary.
bool elements_conform(Results<2>&, RunState&, Unresolved<2>&) { return true; }

bool elements_conform(Results<3>& results, RunState& run, Unresolved<3>& unresolved) {
  const Communicator& comm = results.communicator();
  const PhaseTimer timer(results.level().timers, Phase::conformity);
  const Conformity<3> conformity = conformity_of(results);
  if (!conformity.holds())
    run.warnings.emplace_back(WarningCode::not_conforming, text_of(conformity, results),
                              conformity.faults());
  unresolved = {};
  unresolved.faults = conformity.element_faults();
  unresolved.inner_only =
      conformity.fills() && conformity.boundary.agrees() && !conformity.divides();
  if (conformity.holds()) {
    find_small_angles(results.level(), run, unresolved);
    return true;
  }
  // Without elements, reducing d locally would not help.
  if (!conformity.any_elements()) return false;
  std::vector<Point<3>>& places = unresolved.places;
  const auto none = [&] { return comm.allreduce_sum(places.size()) == 0; };
  places = conformity.torn;
  if (!conformity.divides())
    std::ranges::copy(points_of_crossed_surfaces(results.level(), conformity),
                      std::back_inserter(places));
  if (none()) places = points_of_other_topology(results.level());
  if (none()) places = run.surface_fit.places;
  return false;
}

template void gather_unknown_uses(const Level<2>&, RunState&);
template void gather_unknown_uses(const Level<3>&, RunState&);

}  // namespace pnpbs
