// SPDX-License-Identifier: BSD-3-Clause
#include "level/volume/opposite_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/space_vectors.hpp"
#include "domain/volume/opposite_side.hpp"
#include "domain/volume/surface_walk.hpp"
#include "level/exchange.hpp"
#include "level/reach.hpp"
#include "level/volume/added_nodes.hpp"
#include "level/volume/gaps.hpp"
#include "level/volume/surface_level.hpp"
#include "level/volume/vacancies.hpp"
#include "method/constants.hpp"

namespace pnpbs {

namespace {

// Two directions that are not perpendicular to the edges of a hexagonal lattice along the axes.
constexpr Point<3> kAside{1, 0.268, 1}, kAsideElse{-1, 1, 0.268};

// Returns a direction along the surface: the tangential part of the first one, unless that is
// nearly perpendicular to the surface.
Point<3> aside(const Point<3>& normal) {
  constexpr double kAlong = 0.3;  // lower limit of the squared length
  const Point<3> along = part_across(kAside, normal);
  return unit_vector(dot(along, along) > kAlong ? along : part_across(kAsideElse, normal));
}

constexpr std::size_t kMaxSheets = 16;  // largest number of sheets in one direction

// A sheet of a stack, as seen from a node on another one.
struct Sheet {
  SurfacePoint opposite;  // point opposite to the node
  double squares;         // sum of the squared thicknesses of the walls on the straight path to it
};

// The stacks of close sheets of the surfaces, seen from the nodes of a level.
class ThinWalls {
 public:
  explicit ThinWalls(const Level<3>& level) : level_(level), surface_(level.geometry.surface()) {}

  // Returns the sheets of the surfaces before and behind a surface node, each less than kThinWall d
  // (in a gap kNarrowGap d) from the next one.
  std::vector<Sheet> stack_at(std::int64_t i) const {
    const Nodes<3>& nodes = level_.nodes;
    std::vector<Sheet> stack;
    if (nodes.carrier(i) != Carrier::surface) return stack;
    for (const SideOfFacet side : {SideOfFacet::front, SideOfFacet::back})
      add_sheets(i, side, stack);
    return stack;
  }

  // Returns the distance of the nearest sheet within reach of that point, or infinity.
  double nearest_sheet(const SurfacePoint& at, double d) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const SideOfFacet side : {SideOfFacet::front, SideOfFacet::back})
      if (const auto sheet = next_sheet(at, side, d))
        nearest = std::min(nearest, distance<3>(sheet->position, at.position));
    return nearest;
  }

  // Returns whether the sheet of node i is the one in its stack whose nodes are kept: the one with
  // the first patch or, among sheets of one patch, the first by normal.
  bool leads(std::int64_t i, const std::vector<Sheet>& stack) const {
    const auto rank = [&](std::int32_t facet) {
      return std::pair(surface_.patch(facet), dot(surface_.normal(facet), kAside));
    };
    const std::int32_t here = level_.nodes.boundary_node(i);
    return std::ranges::none_of(
        stack, [&](const Sheet& sheet) { return rank(sheet.opposite.facet) < rank(here); });
  }

  // Returns the partner of node i on another sheet, or nothing without room. Through walls it is
  // shifted aside a little. Four nodes across a wall are then the corners of a parallelogram
  // instead of a rectangle, and rounding makes no flat tetrahedron of them. Tetrahedra in a gap are
  // no elements. If a node is shifted by s relative to one on the next sheet, at distance t, it
  // lies in circumspheres of triangles of that sheet unless s is less than about t^2/d.
  std::optional<IncomingNode<3>> partner(std::int64_t i, const Sheet& sheet) const {
    const double d = level_.nodes.d(i);
    const double way = sheet.squares / d;
    const Point<3> move =
        shifted({}, method::kAsideInThinWall * way, aside(surface_.normal(sheet.opposite.facet)));
    const SurfacePoint at = walk(surface_, sheet.opposite, move);
    const double room = method::kPartnerClearance * d;
    if (surface_.feature_clearance(at, room) < room) return std::nullopt;
    return new_surface_node(level_.geometry, at);
  }

 private:
  SurfacePoint place(std::int64_t i) const {
    return {level_.nodes.boundary_node(i), level_.nodes.position(i)};
  }
  bool is_in_body(const SurfacePoint& from, SideOfFacet side) const {
    return side == SideOfFacet::back || !surface_.facet(from.facet).bounds();
  }
  std::optional<SurfacePoint> next_sheet(const SurfacePoint& from, SideOfFacet side,
                                         double d) const {
    const double reach = (is_in_body(from, side) ? method::kThinWall : method::kNarrowGap) * d;
    return opposite_side(surface_, level_.geometry.domain().index(), from, side, reach);
  }
  void add_sheets(std::int64_t i, SideOfFacet side, std::vector<Sheet>& stack) const {
    const Point<3>& ahead = surface_.normal(level_.nodes.boundary_node(i));
    SurfacePoint from = place(i);
    double squares = 0;
    for (std::size_t sheet = 0; sheet < kMaxSheets; ++sheet) {
      const bool turned = dot(surface_.normal(from.facet), ahead) < 0;
      const SideOfFacet onwards =
          turned == (side == SideOfFacet::front) ? SideOfFacet::back : SideOfFacet::front;
      const std::optional<SurfacePoint> next = next_sheet(from, onwards, level_.nodes.d(i));
      if (!next) return;
      if (is_in_body(from, onwards)) {
        const double thickness = distance<3>(from.position, next->position);
        squares += thickness * thickness;
      }
      stack.push_back({*next, squares});
      from = *next;
    }
  }

  const Level<3>& level_;
  const Surface& surface_;
};

// The exchange of nodes on the sheets of stacks.
struct Replacement {
  std::vector<std::int32_t> leaving;  // memory indices, including ghosts
  IncomingNodes<3> partners;          // partners of owned nodes
};

Replacement replacement_on(const Level<3>& level) {
  const ThinWalls walls(level);
  std::vector<std::vector<Sheet>> stacks(static_cast<std::size_t>(level.nodes.count));
  for_each("pnpbs::replacement_on", level.nodes.count,
           [&](std::int64_t i) { stacks[static_cast<std::size_t>(i)] = walls.stack_at(i); });
  Replacement result;
  for (std::int64_t i = 0; i < level.nodes.count; ++i) {
    const std::vector<Sheet>& stack = stacks[static_cast<std::size_t>(i)];
    if (stack.empty()) continue;
    if (!walls.leads(i, stack)) {
      result.leaving.push_back(static_cast<std::int32_t>(i));
    } else if (level.nodes.owned(i) != 0) {
      for (const Sheet& sheet : stack)
        if (const auto partner = walls.partner(i, sheet)) result.partners.push_back(*partner);
    }
  }
  return result;
}

}  // namespace

double room_on_thin_wall(const Level<3>& level, const SurfacePoint& at, double d) {
  constexpr double kRoom = 0.2;  // with 1, the shell of a cube with a wall of 0.1 d is torn
  const double distance = ThinWalls(level).nearest_sheet(at, d);
  return kRoom * method::kAsideInThinWall * distance * distance / d;
}

bool connects_thin_wall(const Level<3>& level, const Point<3>& centroid, double d) {
  const SurfaceIndex& index = level.geometry.domain().index();
  const double reach = method::kThinWall * d;
  const NearestPoint<3> nearest = index.nearest(centroid, reach);
  const Surface& surface = level.geometry.surface();
  if (nearest.facet < 0 || surface.patch(nearest.facet) < 0) return false;
  const bool before = dot(difference(centroid, nearest.x), surface.normal(nearest.facet)) > 0;
  return opposite_side(surface, index, {nearest.facet, nearest.x},
                       before ? SideOfFacet::front : SideOfFacet::back, reach)
      .has_value();
}

namespace {

// Replaces the nodes once. The counts are 0 if there are no thin walls. All ranks must call it, and
// if one rank throws, all ranks throw.
PopulationCounts replace_nodes(Level<3>& level) {
  PopulationCounts counts;
  level.nodes.set_reference_positions();
  exchange(level, kStarHops);
  Replacement replacement;
  std::uint64_t leaving = 0;
  collective_try(*level.comm, [&] {
    replacement = replacement_on(level);
    for (const std::int32_t i : replacement.leaving) leaving += level.nodes.owned(i) != 0;
  });
  counts.deleted = static_cast<std::int64_t>(level.comm->allreduce_sum(leaving));
  const std::uint64_t coming = level.comm->allreduce_sum(replacement.partners.size());
  if (counts.deleted == 0 && coming == 0) return counts;
  scatter_to_owners(level, replacement.partners);
  delete_nodes(level, replacement.leaving);
  counts.inserted = add_nodes(level, in_gaps(level, replacement.partners, method::kPartnerGap));
  return counts;
}

}  // namespace

// Nodes inserted in the vacancies of one sheet have no partners on the others yet, so rounds
// follow.
PopulationCounts place_opposite_nodes(Level<3>& level) {
  constexpr int kMaxRounds = 3;
  PopulationCounts counts = replace_nodes(level);
  if (counts.inserted + counts.deleted == 0) return counts;
  for (int round = 0; round < kMaxRounds; ++round) {
    const std::int64_t filled = fill_vacancies(level);
    if (filled == 0) break;
    const PopulationCounts more = replace_nodes(level);
    counts.inserted += filled + more.inserted;
    counts.deleted += more.deleted;
  }
  return counts;
}

}  // namespace pnpbs
