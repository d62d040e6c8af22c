// SPDX-License-Identifier: BSD-3-Clause
#include "level/volume/boundary_refinement.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "base/found_indices.hpp"
#include "base/space_vectors.hpp"
#include "comm/records.hpp"
#include "delaunay/volume/circumsphere.hpp"
#include "domain/volume/surface_walk.hpp"
#include "level/finish.hpp"
#include "level/volume/added_nodes.hpp"
#include "level/volume/blocking_nodes.hpp"
#include "level/volume/inner_facets.hpp"
#include "level/volume/open_faces.hpp"
#include "level/volume/settled_elements.hpp"
#include "level/volume/surface_level.hpp"
#include "method/constants.hpp"

namespace pnpbs {

namespace {

using FaceCorners = std::array<std::int64_t, 3>;

// The ball through the corners of a face whose centre lies on a surface.
struct SurfaceBall {
  double radius;
  std::array<std::int64_t, 3> ids;  // ids of the corners, ascending
  Point<3> x;
  std::int64_t facet;

  // Orders by radius, the largest first.
  bool operator<(const SurfaceBall& other) const {
    return std::tie(other.radius, ids) < std::tie(radius, other.ids);
  }
};

// The defects that refinement must reduce: boundary faces with inner nodes, nodes without a disk,
// and faces between tetrahedra that cross inner surfaces.
struct BoundaryDefects {
  std::vector<SurfaceBall> balls;
  std::uint64_t count = 0;
};

bool see_each_other(const Level<3>& level, std::int64_t i, std::int64_t j) {
  const LevelGeometry<3>& geometry = level.geometry;
  return geometry.surface().sees(geometry.place(level.nodes, i), geometry.place(level.nodes, j));
}

// Returns the corner that determines on which sheet of the surface the centre of the ball lies: the
// first by id that lies on a surface. If the face connects node `from` with another sheet, it is a
// corner on that sheet.
std::int64_t corner_of_sheet(const Level<3>& level, const FaceCorners& by_id, std::int64_t from) {
  const Nodes<3>& nodes = level.nodes;
  std::int64_t found = -1;
  for (const std::int64_t i : by_id) {
    if (nodes.carrier(i) != Carrier::surface) continue;
    if (found < 0 && i != from) found = i;
    if (from >= 0 && i != from && !see_each_other(level, i, from)) return i;
  }
  return found;
}

// The smallest ball through the corners of a face.
struct FaceBall {
  Point<3> centre;
  double radius;
  std::array<std::int64_t, 3> ids;  // ids of the corners, ascending
  Point<3> corner;                  // that with the smallest id
};

// Returns the ball of a face, with the same bits for each order of the corners. Sorts the corners
// by their ids. Returns nothing if they lie on a line.
std::optional<FaceBall> face_ball(const Level<3>& level, FaceCorners& corners) {
  const Nodes<3>& nodes = level.nodes;
  std::ranges::sort(corners, {}, [&](std::int64_t i) { return nodes.id(i); });
  FaceBall ball{};
  std::array<Point<3>, 3> x;
  for (std::size_t k = 0; k < 3; ++k) {
    x[k] = nodes.position(corners[k]);
    ball.ids[k] = nodes.id(corners[k]);
  }
  ball.centre = circle_centre(x);
  ball.radius = distance<3>(ball.centre, x[0]);
  ball.corner = x[0];
  if (!(ball.radius < std::numeric_limits<double>::infinity())) return {};
  return ball;
}

SurfaceBall moved_to(const FaceBall& ball, const Point<3>& x, std::int32_t facet) {
  return {distance<3>(x, ball.corner), ball.ids, x, facet};
}

// Returns the surface ball of a face. `from` is a node on one sheet of the surface if the face
// leads to another sheet, else -1. Returns nothing if no corner lies on a surface and none is near.
std::optional<SurfaceBall> surface_ball(const Level<3>& level, FaceCorners corners,
                                        std::int64_t from = -1) {
  const std::optional<FaceBall> ball = face_ball(level, corners);
  if (!ball) return {};
  const Surface& surface = level.geometry.surface();
  const std::int64_t on_sheet = corner_of_sheet(level, corners, from);
  if (on_sheet >= 0) {
    const SurfacePoint at = pull_back(surface, ball->centre, level.nodes.boundary_node(on_sheet));
    return moved_to(*ball, at.position, at.facet);
  }
  const NearestPoint<3> at =
      level.geometry.domain().index().nearest(ball->centre, 2 * ball->radius);
  if (from >= 0 || at.facet < 0 || surface.patch(at.facet) < 0) return {};
  return moved_to(*ball, at.x, at.facet);
}

// Returns the ball of a face between tetrahedra that cross an inner surface, with its centre on
// this surface. Returns nothing if that lies beside a feature edge, where d must be smaller.
std::optional<SurfaceBall> inner_surface_ball(const Level<3>& level, const InnerFacet& stray) {
  FaceCorners corners = stray.nodes;
  const std::optional<FaceBall> ball = face_ball(level, corners);
  if (!ball) return {};
  const Surface& surface = level.geometry.surface();
  const SurfacePoint at = pull_back(surface, ball->centre, stray.facet);
  const SurfaceBall moved = moved_to(*ball, at.position, at.facet);
  const double room = method::kBallTaken * moved.radius;
  if (surface.feature_clearance(at, room) < room) return {};
  return moved;
}

// Adds the defects at node i. A face is counted at its node with the smallest id.
void add_strays_at(const Level<3>& level, std::int64_t i, BoundaryDefects& strays) {
  const Nodes<3>& nodes = level.nodes;
  const FaceFan fan = open_faces(level, i);
  const auto is_free = [&](std::int64_t j) { return nodes.carrier(j) == Carrier::free; };
  const auto is_first = [&](std::int64_t j) { return nodes.id(i) < nodes.id(j); };
  // Faces that do not lie along a surface show where a node is missing.
  std::vector<SurfaceBall> along, across;
  for (const auto& [a, b] : fan) {
    const std::optional<SurfaceBall> ball = surface_ball(level, {i, a, b});
    if (lies_along_surface(level, {i, a, b})) {
      if (ball) along.push_back(*ball);
    } else if (const auto beyond = surface_ball(level, {i, a, b}, is_free(i) ? -1 : i)) {
      across.push_back(*beyond);
    }
    if (!(is_free(i) || is_free(a) || is_free(b)) || !is_first(a) || !is_first(b)) continue;
    ++strays.count;
    if (ball) strays.balls.push_back(*ball);
  }
  if (!lacks_disks(level, i, fan)) return;
  ++strays.count;
  const std::vector<SurfaceBall>& around = across.empty() ? along : across;
  if (!around.empty()) strays.balls.push_back(*std::min_element(around.begin(), around.end()));
}

bool has_strays(const Level<3>& level, std::int64_t i) {
  if (level.nodes.owned(i) == 0 || level.stars.closed(i)) return false;
  const FaceFan fan = open_faces(level, i);
  const auto is_free = [&](std::int64_t j) { return level.nodes.carrier(j) == Carrier::free; };
  return is_free(i) ||
         std::ranges::any_of(
             fan,
             [&](const FaceSide& side) { return is_free(side.first) || is_free(side.second); }) ||
         lacks_disks(level, i, fan);
}

BoundaryDefects strays_of_own(const Level<3>& level, RefinedSurfaces surfaces) {
  BoundaryDefects strays;
  for (const std::int64_t i : indices_where("pnpbs::strays_of_own", level.nodes.count,
                                            [&](std::int64_t k) { return has_strays(level, k); }))
    add_strays_at(level, i, strays);
  if (surfaces == RefinedSurfaces::boundary) return strays;
  for (const std::int64_t i :
       indices_where("pnpbs::inner_strays", level.nodes.count, [&](std::int64_t k) {
         return level.nodes.owned(k) != 0 && !InnerFacets(level).strays_at(k).empty();
       })) {
    InnerFacets facets(level);
    for (const InnerFacet& stray : facets.strays_at(i)) {
      // Faces without inner nodes mostly join feature edges, which need a smaller d instead.
      if (std::ranges::none_of(
              stray.nodes, [&](std::int64_t j) { return level.nodes.carrier(j) == Carrier::free; }))
        continue;
      ++strays.count;
      if (const auto ball = inner_surface_ball(level, stray)) strays.balls.push_back(*ball);
    }
  }
  return strays;
}

// Returns whether a node on the same sheet of the surface is about as close to the centre of the
// ball.
bool is_taken(const Level<3>& level, const IncomingNode<3>& middle, double radius) {
  const Nodes<3>& nodes = level.nodes;
  const LevelGeometry<3>& geometry = level.geometry;
  const SurfaceSupport at = geometry.place(middle.carrier, middle.boundary_node);
  const Buckets<3>& buckets = level.neighbourhood.buckets();
  bool taken = false;
  buckets.for_neighbours(level.tree->tree().leaf_at(middle.position), [&](std::int32_t b) {
    for (std::int64_t i = buckets.begin(b); !taken && i < buckets.end(b); ++i)
      taken = nodes.carrier(i) != Carrier::free &&
              distance<3>(nodes.position(i), middle.position) < method::kBallTaken * radius &&
              geometry.surface().sees(geometry.place(nodes, i), at);
  });
  return taken;
}

// Returns, of the balls of all ranks that are too close to each other, the largest ones. There are
// few, so they are gathered on all ranks. Collective.
std::vector<SurfaceBall> largest_apart(const Communicator& comm,
                                       const std::vector<SurfaceBall>& own) {
  std::vector<SurfaceBall> all = of_all_ranks(comm, own), kept;
  std::sort(all.begin(), all.end());
  for (const SurfaceBall& ball : all)
    if (std::ranges::none_of(kept, [&](const SurfaceBall& other) {
          return distance<3>(other.x, ball.x) < method::kBallsApart * other.radius;
        }))
      kept.push_back(ball);
  return kept;
}

// Returns the new nodes that this rank owns. The owner of a point on a level set may not own the
// point on its triangle.
IncomingNodes<3> new_nodes(const Level<3>& level, const std::vector<SurfaceBall>& balls) {
  IncomingNodes<3> nodes;
  for (const SurfaceBall& ball : balls)
    nodes.push_back(
        new_surface_node(level.geometry, {static_cast<std::int32_t>(ball.facet), ball.x}));
  put_on_level_sets(level.geometry, nodes);
  IncomingNodes<3> own;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (level.tree->owns(level.tree->tree().leaf_at(nodes[k].position)) &&
        !is_taken(level, nodes[k], balls[k].radius))
      own.push_back(nodes[k]);
  return own;
}

// Returns the defects at the owned nodes. All ranks must call it, and if one rank throws, all ranks
// throw.
BoundaryDefects find_strays(Level<3>& level, RefinedSurfaces surfaces) {
  BoundaryDefects own;
  collective_try(*level.comm, [&] { own = strays_of_own(level, surfaces); });
  return own;
}

// Returns the nodes in the balls of all ranks that this rank will own. All ranks must call it, and
// if one rank throws, all ranks throw.
IncomingNodes<3> nodes_in_balls(Level<3>& level, const std::vector<SurfaceBall>& own_balls) {
  const std::vector<SurfaceBall> balls = largest_apart(*level.comm, own_balls);
  IncomingNodes<3> nodes;
  collective_try(*level.comm, [&] { nodes = new_nodes(level, balls); });
  return nodes;
}

// Inserts nodes in rounds as long as the number of defects decreases. Returns the number of nodes
// over all ranks. Collective.
std::int64_t add_boundary_nodes(Level<3>& level, RefinedSurfaces surfaces) {
  constexpr std::uint64_t kFew = method::kFewStrays;
  std::int64_t added = 0;
  std::uint64_t before = 0;
  for (int round = 0; round < method::kMaxBallRounds; ++round) {
    make_finish_stars(level, {});
    settle_elements(level, kQuickRounds);
    const BoundaryDefects own = find_strays(level, surfaces);
    const std::uint64_t strays = level.comm->allreduce_sum(own.count);
    if (strays == 0 || (round >= method::kBallRoundsAnyway && strays >= std::max(before, kFew)))
      break;
    before = strays;
    const std::int64_t more = add_nodes(level, nodes_in_balls(level, own.balls));
    if (more == 0) break;
    added += more;
  }
  return added;
}

}  // namespace

PopulationCounts refine_boundary(Level<3>& level, RefinedSurfaces surfaces) {
  const PhaseTimer timer(level.timers, Phase::conformity);
  PopulationCounts counts;
  if (level.geometry.kind() == GeometryKind::surface) return counts;
  std::int64_t nodes_off = std::numeric_limits<std::int64_t>::max();
  for (int round = 0; round <= method::kMaxBoundaryRounds; ++round) {
    counts.inserted += add_boundary_nodes(level, surfaces);
    const std::int64_t removed =
        round < method::kMaxBoundaryRounds ? remove_blocking_nodes(level, nodes_off) : 0;
    counts.deleted += removed;
    if (removed == 0) break;
  }
  return counts;
}

}  // namespace pnpbs
