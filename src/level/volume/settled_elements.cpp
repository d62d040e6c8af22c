// SPDX-License-Identifier: BSD-3-Clause
#include "level/volume/settled_elements.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "base/union_find.hpp"
#include "comm/records.hpp"
#include "delaunay/volume/circumsphere.hpp"
#include "delaunay/volume/domain_rule.hpp"
#include "level/finding_stars.hpp"
#include "level/volume/boundary_euler.hpp"
#include "level/volume/boundary_pieces.hpp"
#include "level/volume/open_faces.hpp"
#include "level/volume/surface_stars.hpp"
#include "method/constants.hpp"
#include "quality/volume/small_angles.hpp"

namespace pnpbs {

std::int64_t disks_of_surfaces(const Level<3>& level, std::int64_t i) {
  const Nodes<3>& nodes = level.nodes;
  if (nodes.carrier(i) == Carrier::free) return 0;
  std::vector<SurfaceSide> sides;
  bool all_bound = true;
  level.geometry.surface().for_sides(level.geometry.place(nodes, i), [&](const SurfaceSide& side) {
    sides.push_back(side);
    all_bound = all_bound && level.geometry.patch_bounds_domain(side.patch);
  });
  if (!all_bound) return 0;
  // Sides follow each other around a disk: each ends on the curve on which the next one begins.
  UnionFind<std::size_t> disks(sides.size());
  auto count = std::ssize(sides);
  for (std::size_t a = 0; a < sides.size(); ++a)
    for (std::size_t b = 0; b < sides.size(); ++b) {
      if (sides[a].end.curve < 0 || sides[a].end != sides[b].begin) continue;
      if (disks.root(a) != disks.root(b)) --count;
      disks.join(a, b);
    }
  return count;
}

bool lacks_disks(const Level<3>& level, std::int64_t i, const FaceFan& fan) {
  const std::int64_t disks = disks_of_surfaces(level, i);
  return disks > 0 && disks_of(fan) != disks;
}

bool is_torn_around(const Level<3>& level, std::int64_t i) {
  if (!level.nodes.owned(i)) return false;
  const FaceFan fan = open_faces(level, i);
  return level.nodes.carrier(i) == Carrier::free ? !fan.empty() : lacks_disks(level, i, fan);
}

bool lies_along_surface(const Level<3>& level, const std::array<std::int64_t, 3>& corners) {
  // Cosine: allows rough creases, but not the step from sheet to sheet.
  constexpr double kFold = -0.5;
  std::array<SurfaceSupport, 3> places;
  for (std::size_t k = 0; k < 3; ++k) {
    if (level.nodes.carrier(corners[k]) == Carrier::free) return false;
    places[k] = level.geometry.place(level.nodes, corners[k]);
  }
  return level.geometry.surface().share_patch(places, kFold);
}

namespace {

bool is_torn(const Level<3>& level, std::int64_t i) {
  const std::int64_t disks = disks_of_surfaces(level, i);
  if (disks == 0) return false;
  const FaceFan fan = open_faces(level, i);
  return disks_of(fan) != disks || !std::ranges::all_of(fan, [&](const FaceSide& side) {
           return lies_along_surface(level, {i, side.first, side.second});
         });
}

// Returns flags of the owned nodes at which the boundary is torn.
std::vector<char> torn_nodes(const Level<3>& level) {
  const Nodes<3>& nodes = level.nodes;
  std::vector<char> torn(static_cast<std::size_t>(nodes.count), 0);
  for_each("pnpbs::torn_nodes", nodes.count, [&](std::int64_t i) {
    torn[static_cast<std::size_t>(i)] = nodes.owned(i) != 0 && is_torn(level, i);
  });
  return torn;
}

// Returns the stars of these owned nodes, including tetrahedra outside the domain.
VolumeStars whole_stars(const Level<3>& level, const std::vector<char>& wanted) {
  const KnownRegion<3> everywhere;  // the known nodes suffice for stars that exist already
  VolumeStarInput all = star_input(level, everywhere);
  all.facets = nullptr;
  VolumeStars stars;
  stars.build_none(all);
  stars.add(all, wanted);
  return stars;
}

// Returns the ids of these nodes and of all nodes that share a tetrahedron with them.
std::vector<std::int64_t> ids_around(const Level<3>& level, const std::vector<char>& torn) {
  const Nodes<3>& nodes = level.nodes;
  const VolumeStars stars = whole_stars(level, torn);
  std::vector<std::int64_t> ids;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    if (!torn[static_cast<std::size_t>(i)]) continue;
    ids.push_back(nodes.id(i));
    stars.for_neighbours(i, [&](std::int64_t j) { ids.push_back(nodes.id(j)); });
  }
  return ids;
}

// Returns flags of the owned boundary nodes with one of these ids.
std::vector<char> owned_among(const Level<3>& level, const std::vector<std::int64_t>& sorted_ids) {
  const Nodes<3>& nodes = level.nodes;
  std::vector<char> among(static_cast<std::size_t>(nodes.count), 0);
  for (std::int64_t i = 0; i < nodes.count; ++i)
    among[static_cast<std::size_t>(i)] = nodes.owned(i) != 0 && disks_of_surfaces(level, i) > 0 &&
                                         std::ranges::binary_search(sorted_ids, nodes.id(i));
  return among;
}

// Returns the element label of a tetrahedron, with everything that decides whether it may change.
LabelledTetrahedron labelled(const Level<3>& level, const VolumeStarInput& input,
                             const std::array<std::int64_t, 4>& corners) {
  const Tetrahedron t = ordered_by_id(tetrahedron_of(level.nodes, corners));
  LabelledTetrahedron result{
      {t[0].id, t[1].id, t[2].id, t[3].id}, in_domain(input, corners), true, 0, {}};
  const auto is_held = [&](std::int64_t i) { return level.nodes.carrier(i) != Carrier::free; };
  result.may_change = std::ranges::all_of(corners, is_held) && !lies_in_boundary(input, t);
  const double longest = longest_edge({t[0].x, t[1].x, t[2].x, t[3].x});
  std::array<std::int64_t, 4> by_id = corners;
  std::ranges::sort(by_id, {}, [&](std::int64_t i) { return level.nodes.id(i); });
  for (std::size_t k = 0; k < 4; ++k)
    result.along[k] =
        lies_along_surface(level, {by_id[(k + 1) % 4], by_id[(k + 2) % 4], by_id[(k + 3) % 4]});
  result.thin = SmallAngles(method::kThinLabel).any({t[0].x, t[1].x, t[2].x, t[3].x});
  if (result.may_change) result.depth = input.nearest(centroid(t), longest).gap / longest;
  return result;
}

// Two neighbours along a feature curve, or a single node.
struct JoinedNodes {
  std::int64_t id, other;  // -1: a single node
  std::int64_t disks;      // number of disks around the first node
};

// The tetrahedra and nodes that this rank contributes to the choice of labels.
struct LabelledStars {
  std::vector<LabelledTetrahedron> tetrahedra;
  std::vector<JoinedNodes> nodes;
};

LabelledStars labelled_stars(const Level<3>& level, const std::vector<char>& wanted) {
  const Nodes<3>& nodes = level.nodes;
  const VolumeStars stars = whole_stars(level, wanted);
  const KnownRegion<3> everywhere;
  const VolumeStarInput input = star_input(level, everywhere);
  LabelledStars found;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    if (!wanted[static_cast<std::size_t>(i)]) continue;
    const std::int64_t disks = disks_of_surfaces(level, i);
    found.nodes.push_back({nodes.id(i), -1, disks});
    stars.for_neighbours(i, [&](std::int64_t j) {
      if (joined(level.geometry, nodes, i, j))
        found.nodes.push_back({nodes.id(i), nodes.id(j), disks});
    });
    stars.for_simplices(i, [&](const VolumeStars::Corners& others) {
      found.tetrahedra.push_back(labelled(level, input, {i, others[0], others[1], others[2]}));
    });
  }
  return found;
}

std::vector<LabelledNode> by_node(const std::vector<JoinedNodes>& joined) {
  std::map<std::int64_t, LabelledNode> by_id;
  for (const JoinedNodes& one : joined) {
    LabelledNode& node =
        by_id.try_emplace(one.id, LabelledNode{one.id, one.disks, {}}).first->second;
    if (one.other >= 0) node.joined.push_back(one.other);
  }
  std::vector<LabelledNode> nodes;
  for (const auto& [id, node] : by_id) nodes.push_back(node);
  return nodes;
}

// Returns flags of the nodes with a star on this rank that are corners of a tetrahedron with a
// changed label.
std::vector<char> changed_nodes(const Level<3>& level,
                                const std::vector<LabelledTetrahedron>& changed) {
  std::vector<std::int64_t> ids;
  for (const LabelledTetrahedron& t : changed) ids.insert(ids.end(), t.ids.begin(), t.ids.end());
  std::ranges::sort(ids);
  const Nodes<3>& nodes = level.nodes;
  std::vector<char> wanted(static_cast<std::size_t>(nodes.count), 0);
  for (std::int64_t i = 0; i < nodes.count; ++i)
    wanted[static_cast<std::size_t>(i)] = (nodes.owned(i) != 0 || level.stars.size(i) > 0) &&
                                          std::ranges::binary_search(ids, nodes.id(i));
  return wanted;
}

}  // namespace

std::int64_t settle_elements(Level<3>& level, int rounds) {
  if (level.geometry.kind() == GeometryKind::surface) return 0;
  const PhaseTimer timer(level.timers, Phase::conformity);
  std::vector<std::int64_t> own_ids;
  std::int64_t torn = 0;
  collective_try(*level.comm, [&] {
    const std::vector<char> torn_here = torn_nodes(level);
    torn = std::ranges::count_if(torn_here, [](char is) { return is != 0; });
    if (torn > 0) own_ids = ids_around(level, torn_here);
  });
  torn = static_cast<std::int64_t>(level.comm->allreduce_sum(static_cast<std::uint64_t>(torn)));
  if (torn == 0) return 0;
  std::vector<std::int64_t> ids = of_all_ranks(*level.comm, own_ids);
  std::ranges::sort(ids);
  LabelledStars own;
  collective_try(*level.comm, [&] { own = labelled_stars(level, owned_among(level, ids)); });
  const std::vector<LabelledTetrahedron> tetrahedra = of_all_ranks(*level.comm, own.tetrahedra);
  const std::vector<JoinedNodes> nodes = of_all_ranks(*level.comm, own.nodes);
  const std::int64_t euler = euler_of_boundary(level), pieces = pieces_of_boundary(level);
  collective_try(*level.comm, [&] {
    ElementLabels labels(tetrahedra, by_node(nodes));
    labels.settle();
    labels.search(euler_of_surfaces(level) - euler, pieces_of_surfaces(level) - pieces, rounds);
    labels.drop_thin_elements();
    const std::vector<LabelledTetrahedron> changed = labels.changed();
    level.changed_labels = ChangedLabels(changed);
    const KnownRegion<3> everywhere;
    level.stars.add(star_input(level, everywhere), changed_nodes(level, changed));
  });
  return torn;
}

}  // namespace pnpbs
