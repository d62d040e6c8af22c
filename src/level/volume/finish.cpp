// SPDX-License-Identifier: BSD-3-Clause
#include "level/finish.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "base/space_vectors.hpp"
#include "delaunay/volume/domain_rule.hpp"
#include "domain/volume/surface.hpp"
#include "geometry/volume/triangles.hpp"
#include "implicit/level_set.hpp"
#include "level/exchange.hpp"
#include "level/finding_stars.hpp"
#include "level/lists_and_stars.hpp"
#include "level/node_digest.hpp"
#include "level/reach.hpp"
#include "level/rebalance.hpp"
#include "level/volume/inner_facets.hpp"
#include "level/volume/opposite_nodes.hpp"
#include "level/volume/surface_level.hpp"
#include "level/volume/thin_elements.hpp"
#include "method/constants.hpp"
#include "quality/volume/mean_sweep.hpp"
#include "quality/volume/sliver_repair.hpp"
#include "quality/volume/small_angles.hpp"

namespace pnpbs {

namespace {

// Returns the test of whether a node may move to a point.
auto may_go(const Level<3>& level) {
  return [&level, inner = level.geometry.has_inner_surfaces()](std::int64_t i, const Point<3>& x) {
    const NearBoundary<3>& near = level.neighbourhood.near_boundary();
    const double d = level.nodes.d(i);
    return near.stays_clear(i, level.nodes, level.geometry, x, method::kFinishClearance * d) &&
           (!inner || near.stays_clear_of_inner(i, level.nodes, level.geometry, x,
                                                method::kInnerClearance * d));
  };
}

// Moves nodes towards the means of their neighbours in the present stars. A few edges have other
// nodes after the first sweep, which does not affect the next ones much. Ghosts are updated.
void sweep_to_means(Level<3>& level, std::int64_t sweeps) {
  for (std::int64_t s = 0; s < sweeps; ++s) {
    update_ghosts(level);
    collective_try(*level.comm, [&] {
      level.timers.add(
          Phase::sweeps,
          pnpbs::sweep_to_means(level.nodes, level.stars, level.settings.sweep.weight,
                                level.time_integration.scratch(level.nodes), may_go(level)));
    });
  }
  level.time_integration = {};  // Releases its memory, because repairs need more than sweeps.
}

// Moves points near level sets to where these are 0. A point gets the facet -1 if there is no such
// point within the distance that nodes have from triangles.
void settle_on_level_sets(const LevelGeometry<3>& geometry,
                          std::vector<AlongSurfaces::Place>& places) {
  const LevelSetTriangles& triangles = geometry.domain().level_sets();
  const double reach = geometry.boundary().node_distance;
  for (const std::shared_ptr<const LevelSet>& set : triangles.sets) {
    if (!set) continue;
    std::vector<std::size_t> on_set;
    std::vector<Point<3>> x;
    for (std::size_t k = 0; k < places.size(); ++k)
      if (places[k].facet >= 0 && triangles.at(places[k].facet) == set.get()) {
        on_set.push_back(k);
        x.push_back(places[k].x);
      }
    const std::vector<char> found = set->project(x, reach);
    for (std::size_t k = 0; k < on_set.size(); ++k) {
      AlongSurfaces::Place& place = places[on_set[k]];
      const FacetCorners<3> facet = geometry.surface().corners(place.facet);
      const bool near = distance<3>(nearest_on(facet, x[k]), x[k]) <= reach;
      place.x = x[k];
      if (!found[k] || !near) place.facet = -1;
    }
  }
}

// Repairs elements with an angle below this many degrees, until none is left or too many attempts
// have failed: in a wall thinner than d nearly all tetrahedra stay thin. Ghosts are updated.
void repair_rounds(Level<3>& level, SliverRepair& repair, const SliverRule& rule, double below) {
  const auto sum = [&](std::int64_t own) {
    return level.comm->allreduce_sum(static_cast<std::uint64_t>(own));
  };
  constexpr double kFewNodes = 1000;  // small bodies need no limit
  const double most_in_vain =
      method::kMaxInVain * std::max(kFewNodes, static_cast<double>(sum(level.owned_count())));
  std::uint64_t failed_attempts = 0;
  for (std::int64_t round = 0; round < rule.rounds; ++round) {
    if (sum(repair.slivers(below)) == 0 || static_cast<double>(failed_attempts) > most_in_vain)
      break;
    collective_try(*level.comm, [&] { repair.draw(round, below); });
    if (level.distributed()) {
      const auto draws = level.ghosts.tell<SliverDraw>(
          *level.comm, level.nodes, repair.drawn_corners(),
          [&](std::int32_t corner) { return repair.draws_of(corner); });
      collective_try(*level.comm, [&] { repair.take(draws); });
    }
    collective_try(*level.comm, [&] { repair.move(); });
    failed_attempts += sum(repair.failed_attempts());
    if (!level.distributed()) continue;
    const auto news =
        level.ghosts.tell<ChangedTetrahedron>(*level.comm, level.nodes, repair.moved_nodes(),
                                              [&](std::int32_t i) { return repair.changes_of(i); });
    collective_try(*level.comm, [&] { repair.follow(news); });
  }
}

// Returns the point of a surface on which node i lay before the repair.
SurfacePoint before_repair(const Nodes<3>& nodes, std::int64_t i) {
  return {nodes.reference_on(i), point_at<3>(nodes.reference, i)};
}

// Returns the largest length of one move of node i. A node may be twice as far from its position
// before the repair.
double room_on_surface(const Level<3>& level, std::int64_t i) {
  if (level.nodes.carrier(i) != Carrier::surface) return HUGE_VAL;
  return room_on_thin_wall(level, before_repair(level.nodes, i), level.nodes.d(i));
}

// The faces of the present elements that represent surfaces inside the body.
class KeptFacets {
 public:
  explicit KeptFacets(const Level<3>& level) {
    InnerFacets facets(level);
    for (std::int64_t i = 0; i < level.nodes.count; ++i)
      if (level.stars.size(i) > 0)
        for (const InnerFacet& facet : facets.at(i)) facets_.push_back(sorted(facet.nodes));
    std::ranges::sort(facets_);
  }

  // Returns whether each of these faces that a removed tetrahedron has is a face of a new one.
  bool are_kept_by(const StarChange& change) const {
    std::vector<Corners> kept;
    for (const TetrahedronNodes& t : change.made) add_facets_of(t, kept);
    std::ranges::sort(kept);
    std::vector<Corners> before;
    for (const TetrahedronNodes& t : change.gone) add_facets_of(t, before);
    return std::ranges::all_of(
        before, [&](const Corners& face) { return std::ranges::binary_search(kept, face); });
  }

 private:
  using Corners = std::array<std::int64_t, 3>;

  static Corners sorted(Corners nodes) {
    std::ranges::sort(nodes);
    return nodes;
  }
  void add_facets_of(const TetrahedronNodes& t, std::vector<Corners>& found) const {
    for (std::size_t k = 0; k < 4; ++k) {
      const Corners face = sorted({t[(k + 1) % 4], t[(k + 2) % 4], t[(k + 3) % 4]});
      if (std::ranges::binary_search(facets_, face)) found.push_back(face);
    }
  }

  std::vector<Corners> facets_;  // in ascending order, as the indices of their nodes
};

// Whether nodes on surfaces inside the body may move along them.
enum class OnInnerSurfaces { stay, move };

// Returns the rules by which nodes move along surfaces. Nodes on thin walls may move little, so
// that they stay opposite their partners. Nodes of a level set keep their distance from its
// triangles on the way.
AlongSurfaces ways_along_surfaces(const Level<3>& level, const VolumeStarInput& input,
                                  OnInnerSurfaces inner) {
  const bool inner_too = inner == OnInnerSurfaces::move;
  const auto walk = [&level, inner_too](std::int64_t i, const Point<3>& direction, double length) {
    const LevelGeometry<3>& geometry = level.geometry;
    const AlongSurfaces::Place from{level.nodes.position(i), level.nodes.boundary_node(i)};
    if (!inner_too && !geometry.bounds_domain(from.facet)) return from;
    const double way = room_on_surface(level, i);
    const SurfacePoint to = go_along_surface(level, i, direction, std::min(length, way));
    if (distance<3>(to.position, before_repair(level.nodes, i).position) > 2 * way) return from;
    if (!geometry.domain().level_sets().at(to.facet))
      return AlongSurfaces::Place{to.position, to.facet};
    const Surface& surface = geometry.surface();
    const double off =
        dot(surface.normal(from.facet), difference(from.x, surface.corners(from.facet)[0]));
    return AlongSurfaces::Place{shifted(to.position, off, surface.normal(to.facet)), to.facet};
  };
  const auto rule = [&input](const std::array<std::int64_t, 4>& nodes, const Tetrahedron& corners) {
    return in_domain(input, nodes, corners);
  };
  AlongSurfaces ways{walk, rule, {}, {}};
  if (inner_too && level.geometry.has_inner_surfaces())
    ways.keeps_inner_facets = [facets = KeptFacets(level)](const StarChange& change) {
      return facets.are_kept_by(change);
    };
  if (!level.geometry.domain().level_sets().sets.empty())
    ways.settle = [&level](std::vector<AlongSurfaces::Place>& places) {
      settle_on_level_sets(level.geometry, places);
    };
  return ways;
}

// Repairs elements with small angles, the worst first. Otherwise these would rarely be attempted
// where nearly all elements have small angles. Afterwards the stars of the owned nodes are up to
// date.
void repair_slivers(Level<3>& level, double repair_below,
                    OnInnerSurfaces inner = OnInnerSurfaces::stay) {
  make_finish_stars(level, {method::kSliverRings,
                            method::kSliverReach + method::kSliverDrift + method::kSliverEdge});
  level.neighbourhood.release_lists();  // The repair needs the memory for changed stars.
  const SliverRule rule{repair_below};
  const KnownRegion<3> everywhere;
  const VolumeStarInput input = star_input(level, everywhere);
  std::optional<SliverRepair> repair;
  collective_try(*level.comm, [&] {
    repair.emplace(level.nodes, level.stars, rule, may_go(level),
                   ways_along_surfaces(level, input, inner));
  });
  for (const double below : {method::kFlatBelow, method::kThinBelow, rule.repair_below})
    if (below <= rule.repair_below) repair_rounds(level, *repair, rule, below);
  collective_try(*level.comm, [&] { repair->write_stars(level.stars); });
  level.timers.add(Phase::sweeps, repair->stars_looked_at());
  level.unknown_uses += repair->unknown_uses();
  level.nodes.moved();
  const std::uint64_t digest = node_digest(level);
  level.stars_digest = repair->unknown_uses() == 0 ? digest : 0;
}

// Distributes the nodes so that all ranks have about as many small angles to repair: in an even
// cube half of the ranks may have two thirds of them. The stars are those from before the sweeps,
// and ghosts lag behind by a sweep, which does not matter for an estimate.
void balance_repairs(Level<3>& level) {
  if (!level.distributed()) return;
  const Nodes<3>& nodes = level.nodes;
  const SmallAngles small(level.settings.sliver_angle);
  View<std::int64_t> slivers;
  collective_try(*level.comm, [&] {
    slivers = make_view<std::int64_t>("pnpbs::balance_repairs", nodes.count);
    for_each("pnpbs::balance_repairs", nodes.count, [&](std::int64_t i) {
      slivers(i) = 0;
      if (!nodes.owned(i)) return;
      level.stars.for_simplices(i, [&](const VolumeStars::Corners& others) {
        const auto is_later = [&](std::int32_t j) { return nodes.id(i) < nodes.id(j); };
        if (!std::ranges::all_of(others, is_later)) return;  // counted at another corner
        const std::array<Point<3>, 4> x{nodes.position(i), nodes.position(others[0]),
                                        nodes.position(others[1]), nodes.position(others[2])};
        if (!small.surely_none(x)) slivers(i) += small.any(x);
      });
    });
  });
  rebalance_for(level, slivers);
}

// Repairs the elements that remain thin: removes and inserts nodes, and then repairs only the
// thinnest elements. Returns the counts of this rank, or nothing if the monitor stops it.
std::optional<PopulationCounts> repair_thin_elements(Level<3>& level, const StopTest& stops) {
  ThinElementChanges changes = change_nodes_of_thin_elements(level);
  PopulationCounts counts = changes.counts;
  sweep_to_means(level, method::kSweepsBetweenRepairs);
  repair_slivers(level, level.settings.sliver_angle);
  const auto nodes = static_cast<double>(
      level.comm->allreduce_sum(static_cast<std::uint64_t>(level.owned_count())));
  for (int repair = 0; repair < method::kThinRepairs; ++repair) {
    changes = change_nodes_of_thin_elements(level);
    counts.inserted += changes.counts.inserted;
    counts.deleted += changes.counts.deleted;
    if (changes.thin == 0 || static_cast<double>(changes.thin) > method::kManyThin * nodes) break;
    if (stops()) return std::nullopt;
    repair_slivers(level, method::kThinElement, OnInnerSurfaces::move);
  }
  return counts;
}

}  // namespace

FinishResults sweep_and_repair(Level<3>& level, std::int64_t sweeps, const StopTest& stops) {
  const PhaseTimer timer(level.timers, Phase::sweeps);
  if (level.geometry.kind() == GeometryKind::surface) {
    sweep_on_surfaces(level, sweeps);
    put_on_level_sets(level);
    return {};
  }
  FinishResults stopped;
  stopped.stopped = true;
  if (sweeps > 0) make_finish_stars(level, {});
  sweep_to_means(level, sweeps);
  if (level.settings.repair.rounds == 0) return {};
  if (stops()) return stopped;
  if (sweeps > 0) balance_repairs(level);
  repair_slivers(level, level.settings.sliver_angle);
  if (sweeps == 0) {
    // Nodes that were inserted on inner surfaces may be in thin elements with others there.
    if (level.geometry.has_inner_surfaces())
      repair_slivers(level, method::kThinElement, OnInnerSurfaces::move);
    return {};
  }
  if (stops()) return stopped;
  const std::optional<PopulationCounts> counts = repair_thin_elements(level, stops);
  if (!counts) return stopped;
  FinishResults results;
  results.counts = *counts;
  return results;
}

}  // namespace pnpbs
