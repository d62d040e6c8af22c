// SPDX-License-Identifier: BSD-3-Clause
#include "level/finding_stars.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "base/nodes_worked_for.hpp"
#include "delaunay/plane/lawson_flips.hpp"
#include "level/ghost_stars.hpp"
#include "level/node_digest.hpp"
#include "level/volume/surface_stars.hpp"
#include "neighbors/rings.hpp"
#include "sphere/sphere_cap.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

namespace {

StarInput star_input(const Level<2>& level, const KnownRegion<2>& known) {
  const Neighbourhood<2>& neighbourhood = level.neighbourhood;
  return {level.nodes,
          level.map(),
          level.geometry.sectors(),
          neighbourhood.buckets(),
          neighbourhood.lists(),
          neighbourhood.near_boundary().edges(),
          known,
          level.geometry.domain()};
}

}  // namespace

VolumeStarInput star_input(const Level<3>& level, const KnownRegion<3>& known) {
  const Neighbourhood<3>& neighbourhood = level.neighbourhood;
  const auto complete = [&level](std::int64_t i) {
    return level.lists().has(i) && level.neighbourhood.near_boundary().sees_all(i);
  };
  const auto room = [&level](std::int64_t i) {
    const bool measured = level.nodes.moving == Carrier::free;
    return measured ? level.neighbourhood.near_boundary().room(i, level.nodes) : 0;
  };
  // A flat tetrahedron on an inner surface lies inside the domain.
  const auto on_one_surface = [&level](const std::array<std::int64_t, 4>& corners) {
    const LevelGeometry<3>& geometry = level.geometry;
    std::array<SurfaceSupport, 4> places;
    for (std::size_t k = 0; k < 4; ++k) places[k] = geometry.place(level.nodes, corners[k]);
    return geometry.surface().share_patch(places) &&
           std::ranges::all_of(places, [&](const SurfaceSupport& place) {
             bool bounds = false;
             geometry.surface().for_sides(place, [&](const SurfaceSide& side) {
               bounds = bounds || geometry.patch_bounds_domain(side.patch);
             });
             return bounds;
           });
  };
  return {level.nodes,
          level.tree->tree(),
          neighbourhood.buckets(),
          neighbourhood.lists(),
          known,
          &level.geometry.domain().index().sides(),
          complete,
          room,
          on_one_surface,
          [&level](std::int64_t i, std::int64_t j) {
            return joined(level.geometry, level.nodes, i, j);
          },
          [&level](const Point<3>& x, double reach) {
            return level.geometry.domain().index().nearest(x, reach);
          },
          &level.changed_labels};
}

namespace {

SurfaceStarInput surface_star_input(const Level<3>& level, const KnownRegion<3>& known) {
  return {level.nodes,
          level.tree->tree(),
          level.neighbourhood.buckets(),
          known,
          level.geometry.surface(),
          level.geometry.features(),
          [&level](std::int64_t i) { return level.geometry.place(level.nodes, i); }};
}

template <int Dim>
void widen(Box<Dim>& box, const Box<Dim>& by) {
  for (int k = 0; k < Dim; ++k) {
    box.low[k] = std::min(box.low[k], by.low[k]);
    box.high[k] = std::max(box.high[k], by.high[k]);
  }
}

template <int Dim>
std::vector<char> owned_nodes(const Nodes<Dim>& nodes) {
  return {nodes.owned.data(), nodes.owned.data() + nodes.count};
}

void count_stars(Level<3>& level, const std::vector<char>& wanted) {
  level.timers.add(Phase::stars, nodes_worked_for(level.nodes, [&](std::int64_t i) {
                     return wanted[static_cast<std::size_t>(i)] != 0;
                   }));
}

void add_stars(Level<3>& level, const KnownRegion<3>& known, const std::vector<char>& wanted) {
  const PhaseTimer timer(level.timers, Phase::stars);
  level.stars.add(star_input(level, known), wanted);
  count_stars(level, wanted);
}

// Starts the search without stars. If no node has moved since the stored stars were found, these
// are restored.
void begin_stars(Level<3>& level, const KnownRegion<3>& known, bool stored_stars_hold) {
  const PhaseTimer timer(level.timers, Phase::stars);
  const VolumeStarInput input = star_input(level, known);
  level.stars.build_none(input);
  if (!stored_stars_hold) return;
  // Restored stars count as computed, as those that are confirmed one by one do.
  count_stars(level, level.stars_before.restore(input, level.stars));
}

// Returns flags of the owned nodes without a star.
std::vector<char> owned_without_star(const Level<3>& level) {
  std::vector<char> without = owned_nodes(level.nodes);
  for (std::int64_t i = 0; i < level.nodes.count; ++i)
    if (level.stars.found(i)) without[static_cast<std::size_t>(i)] = 0;
  return without;
}

// Finds the stars of the flagged owned nodes. Most stored stars still hold after small moves; these
// are only confirmed.
void find_owned_stars(Level<3>& level, const KnownRegion<3>& known,
                      const std::vector<char>& wanted) {
  if (!level.stars_before.any()) return add_stars(level, known, wanted);
  const PhaseTimer timer(level.timers, Phase::stars);
  level.stars_before.find_stars(star_input(level, known), wanted, level.stars);
  count_stars(level, wanted);
}

void build_stars(Level<2>& level, const KnownRegion<2>& known, bool) {
  const PhaseTimer timer(level.timers, Phase::stars);
  level.timers.add(Phase::stars, {level.nodes.count, level.owned_count()});
  level.stars.build(star_input(level, known));
}
void build_stars(Level<3>& level, const KnownRegion<3>& known, bool stored_stars_hold) {
  const bool on_surfaces = level.geometry.kind() == GeometryKind::surface;
  if (!on_surfaces && (level.stars_before.any() || level.distributed())) {
    begin_stars(level, known, stored_stars_hold);
    return find_owned_stars(level, known, owned_without_star(level));
  }
  const PhaseTimer timer(level.timers, Phase::stars);
  level.timers.add(Phase::stars, {level.nodes.count, level.owned_count()});
  if (on_surfaces) return level.stars.build(surface_star_input(level, known));
  level.stars.build(star_input(level, known));
}

// Collects the boxes in which all nodes must be known before the missing stars can be found: one
// box for the nodes of each leaf, and single leaves with unknown nodes.
template <int Dim>
class UnknownBoxes {
 public:
  UnknownBoxes(const Level<Dim>& level, const KnownRegion<Dim>& known)
      : level_(level), known_(known) {}

  void request_around(std::int64_t i) {
    if constexpr (Dim == 2)
      if (level_.geometry.domain().is_in_patch(level_.nodes.position(i))) return ask_in_cap(i);
    request_around(i, level_.stars.needs(i));
  }
  void request_around(std::int64_t i, double reach) {
    if (reach == 0) return;
    const Box<Dim> box = box_around<Dim>(level_.nodes.position(i), reach);
    widen(box_of_.try_emplace(level_.neighbourhood.buckets().bucket_of(i), box).first->second, box);
  }
  void request_leaf(std::int32_t leaf) { leaves_.insert(leaf); }
  std::vector<Box<Dim>> boxes() const {
    std::vector<Box<Dim>> boxes;
    for (const auto& [leaf, box] : box_of_) boxes.push_back(box);
    const BackgroundTree<Dim>& tree = level_.tree->tree();
    for (const std::int32_t leaf : leaves_) boxes.push_back(tree.cell_box(tree.leaf_cell(leaf)));
    return boxes;
  }

 private:
  void ask_in_cap(std::int64_t i) {
    const double length = level_.stars.needs(i);
    if (length == 0) return;
    const SphereCap cap(level_.geometry.domain().embedding().chart(), level_.nodes.position(i),
                        length);
    known_.for_unknown_leaves(
        level_.tree->tree(),
        [&](std::int32_t cell) { return cap.meets(level_.tree->tree().cell_box_with_room(cell)); },
        [&](std::int32_t leaf) { request_leaf(leaf); });
  }

  const Level<Dim>& level_;
  const KnownRegion<Dim>& known_;
  std::map<std::int32_t, Box<Dim>> box_of_;
  std::set<std::int32_t> leaves_;
};

// Finds the stars of all nodes. Returns the boxes that must be known for the required stars that
// are missing.
template <int Dim>
std::vector<Box<Dim>> find_all_stars(Level<Dim>& level, const KnownRegion<Dim>& known, int rings,
                                     bool stored_stars_hold) {
  build_stars(level, known, stored_stars_hold);
  UnknownBoxes<Dim> unknown(level, known);
  if (known.is_everywhere()) return unknown.boxes();
  const Nodes<Dim>& nodes = level.nodes;
  std::vector<char> reached = owned_nodes(nodes);
  std::vector<std::int64_t> ring;
  for (std::int64_t i = 0; i < nodes.count; ++i)
    if (nodes.owned(i)) ring.push_back(i);
  for (int r = 0;; ++r) {
    for (const std::int64_t i : ring) unknown.request_around(i);
    if (r == rings) return unknown.boxes();
    ring = next_ring(level.stars, ring, reached);
  }
}

// A box around nodes, and the largest of their d.
struct OwnedNodesBox {
  Box<3> box;
  double max_d = 0;  // 0: the box has no nodes
};

// Returns the box around the owned nodes in [begin, end).
OwnedNodesBox owned_nodes_box(const Nodes<3>& nodes, std::int64_t begin, std::int64_t end) {
  OwnedNodesBox owned;
  for (std::int64_t i = begin; i < end; ++i) {
    if (!nodes.owned(i)) continue;
    const Box<3> here{nodes.position(i), nodes.position(i)};
    if (owned.max_d == 0) owned.box = here;
    widen(owned.box, here);
    owned.max_d = std::max(owned.max_d, nodes.d(i));
  }
  return owned;
}

// Requests the unknown leaves that are closer to an owned node than the sum of both reaches.
void request_pairs(const Level<3>& level, const KnownRegion<3>& known, double reach,
                   UnknownBoxes<3>& unknown) {
  const BackgroundTree<3>& tree = level.tree->tree();
  const Buckets<3>& buckets = level.neighbourhood.buckets();
  const Nodes<3>& nodes = level.nodes;
  const auto is_near = [&](std::int64_t i, std::int32_t leaf) {
    const double sum = reach * (nodes.d(i) + level.map().leaf_max_spacing(leaf));
    const Box<3> box = tree.cell_box_with_room(tree.leaf_cell(leaf));
    return squared_gap_to(box, nodes.position(i)) < sum * sum;
  };
  std::vector<double> max_d;
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf)
    max_d.push_back(level.map().leaf_max_spacing(leaf));
  const std::vector<double> max_d_in = max_in_cells(tree, max_d);
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    const OwnedNodesBox owned = owned_nodes_box(nodes, buckets.begin(leaf), buckets.end(leaf));
    if (owned.max_d == 0) continue;
    known.for_unknown_leaves(
        tree,
        [&](std::int32_t cell) {
          const double most = reach * (owned.max_d + max_d_in[static_cast<std::size_t>(cell)]);
          return squared_gap(tree.cell_box_with_room(cell), owned.box) < most * most;
        },
        [&](std::int32_t other) {
          for (std::int64_t i = buckets.begin(leaf); i < buckets.end(leaf); ++i)
            if (nodes.owned(i) && is_near(i, other)) return unknown.request_leaf(other);
        });
  }
}

// Finds the stars of the owned nodes of a body on several ranks, and receives those of ghosts.
// Returns the boxes that must be known for the required stars that are missing. Collective.
std::vector<Box<3>> find_stars_of_body(Level<3>& level, const KnownRegion<3>& known,
                                       const GhostStarDepth& zone, bool stored_stars_hold) {
  UnknownBoxes<3> unknown(level, known);
  collective_try(*level.comm, [&] {
    build_stars(level, known, stored_stars_hold);
    for (std::int64_t i = 0; i < level.nodes.count; ++i)
      if (level.nodes.owned(i)) unknown.request_around(i);
    if (zone.reach > 0) request_pairs(level, known, zone.reach, unknown);
  });
  const PhaseTimer timer(level.timers, Phase::stars);
  receive_ghost_stars(level, zone.rings,
                      [&](std::int64_t i, double reach) { unknown.request_around(i, reach); });
  std::vector<Box<3>> boxes;
  collective_try(*level.comm, [&] { boxes = unknown.boxes(); });
  return boxes;
}

}  // namespace

bool stars_hold(Level<2>&) { return false; }
bool stars_hold(Level<3>& level) {
  if (level.geometry.kind() == GeometryKind::surface) return false;
  const std::uint64_t before = level.stars_before.digest();
  level.stars_digest = node_digest(level);
  return level.comm->allreduce_sum(std::uint64_t{before != level.stars_digest}) == 0;
}

template <int Dim>
void rebuild_stars(Level<Dim>& level) {
  level.changed_labels = {};
  const bool stored_stars_hold = stars_hold(level);
  build_stars(level, KnownRegion<Dim>(), stored_stars_hold);
  level.stars_before.forget();
}

bool restore_stars(Level<2>& level) {
  if (level.distributed()) return false;
  const PhaseTimer timer(level.timers, Phase::stars);
  return restore_by_flips(level.nodes, level.geometry.sectors(), level.stars);
}
bool restore_stars(Level<3>&) { return false; }

std::vector<Box<2>> find_stars(Level<2>& level, const KnownRegion<2>& known,
                               const GhostStarDepth& zone, bool stored_stars_hold) {
  std::vector<Box<2>> unknown;
  collective_try(*level.comm,
                 [&] { unknown = find_all_stars(level, known, zone.rings, stored_stars_hold); });
  return unknown;
}
std::vector<Box<3>> find_stars(Level<3>& level, const KnownRegion<3>& known,
                               const GhostStarDepth& zone, bool stored_stars_hold) {
  std::vector<Box<3>> unknown;
  if (!level.distributed() || level.geometry.kind() == GeometryKind::surface) {
    collective_try(*level.comm,
                   [&] { unknown = find_all_stars(level, known, zone.rings, stored_stars_hold); });
    return unknown;
  }
  return find_stars_of_body(level, known, zone, stored_stars_hold);
}

bool keep_found_stars(Level<2>&) { return false; }
bool keep_found_stars(Level<3>& level) {
  if (level.geometry.kind() == GeometryKind::surface) return false;
  collective_try(*level.comm, [&] { level.stars_before.take(level.nodes, level.stars); });
  return true;
}

template void rebuild_stars(Level<2>&);
template void rebuild_stars(Level<3>&);

}  // namespace pnpbs
