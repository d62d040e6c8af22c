// SPDX-License-Identifier: BSD-3-Clause
#include "level/inexact_nodes.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "level/known_after_exchange.hpp"
#include "level/level.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

namespace {

// The range of a computation: nodes within `radius` desired distances of a node affect it. They may
// have drifted by `drift` of their d since the ghosts were selected. If of_all is true, nodes that
// do not move are affected as well.
struct Sight {
  double radius, drift;
  bool of_all;
};

// Returns whether a node of a leaf unknown to this rank may affect node i.
template <int Dim>
bool may_depend_on_unknown(const Level<Dim>& level, const KnownRegion<Dim>& known,
                           const Sight& sight, std::int64_t i) {
  const BackgroundTree<Dim>& tree = level.tree->tree();
  const Point<Dim> x = level.nodes.position(i);
  const double d = level.nodes.d(i);
  bool sees = false;
  const auto look = [&](std::int32_t cell) { return !sees && known.unknown_in(cell); };
  // A node beyond twice its own d in reach would require a growth of d that nodes cannot follow.
  const double farthest = 2 * sight.radius * d + sight.drift * d;
  tree.for_leaves_in(box_around<Dim>(x, farthest), look, [&](std::int32_t leaf) {
    const double there = level.map().leaf_max_spacing(leaf);
    const double reach = sight.radius * 0.5 * (d + there) + sight.drift * there;
    sees = sees || squared_gap_to(tree.cell_box(tree.leaf_cell(leaf)), x) < reach * reach;
  });
  return sees;
}

template <int Dim>
bool sees_inexact(const Level<Dim>& level, const InexactNodes& inexact, const Sight& sight,
                  std::int64_t i) {
  const Nodes<Dim>& nodes = level.nodes;
  bool sees = false;
  level.lists().for_neighbours(i, [&](std::int64_t j) {
    const double within = sight.radius * 0.5 * (nodes.d(i) + nodes.d(j));
    sees = sees || (distance<Dim>(nodes.position(i), nodes.position(j)) < within &&
                    inexact.contains(nodes.id(j)));
  });
  return sees;
}

// Adds the nodes that an inexact or possibly unknown node affects, `hops` times.
template <int Dim>
void spread(Level<Dim>& level, InexactNodes& inexact, const Sight& sight, int hops) {
  const Nodes<Dim>& nodes = level.nodes;
  const KnownRegion<Dim> known = known_after_exchange(level, level.ghosts.hops());
  for (int hop = 0; hop < hops; ++hop) {
    InexactNodes more;
    for (std::int64_t i = 0; i < nodes.count; ++i)
      if (!inexact.contains(nodes.id(i)) && (sight.of_all || nodes.moves(i)) &&
          (sees_inexact(level, inexact, sight, i) ||
           (hop == 0 && may_depend_on_unknown(level, known, sight, i))))
        more.insert(nodes.id(i));
    inexact.merge(more);
  }
}

template <int Dim>
std::int64_t owned_among(const Level<Dim>& level, const InexactNodes& inexact) {
  std::int64_t count = 0;
  for (std::int64_t i = 0; !inexact.empty() && i < level.nodes.count; ++i)
    count += level.nodes.owned(i) != 0 && inexact.contains(level.nodes.id(i));
  return count;
}

template <int Dim>
bool looks(const Level<Dim>& level) {
  return kCountsUnknownUses && level.distributed();
}

}  // namespace

template <int Dim>
void track_inexact_nodes(Level<Dim>& level, int evaluations) {
  if (!looks(level)) return;
  const Settings& settings = level.settings;
  const double drift =
      settings.motion.max_move * static_cast<double>(level.ghosts.steps_since_choice());
  spread(level, level.inexact, {settings.force_range(), drift, false}, evaluations);
  if (level.neighbourhood.listed() == ListsOf::all_nodes) return;
  for (std::int64_t i = 0; i < level.nodes.count; ++i)  // forces are not computed for these
    if (!level.nodes.owned(i)) level.inexact.insert(level.nodes.id(i));
}

template <int Dim>
void count_inexact_nodes(Level<Dim>& level) {
  if (!looks(level)) return;
  level.unknown_uses += owned_among(level, level.inexact);
  level.inexact.clear();
}

template <int Dim>
void count_uses_by_event(Level<Dim>& level, int hops) {
  if (!looks(level)) return;
  std::vector<std::int32_t> all(static_cast<std::size_t>(level.nodes.count));
  std::iota(all.begin(), all.end(), 0);
  level.neighbourhood.add_lists(level.nodes, level.geometry, *level.tree, all);
  InexactNodes inexact;
  spread(level, inexact, {level.settings.list_radius, 0, true}, hops);
  level.unknown_uses += owned_among(level, inexact);
}

template void track_inexact_nodes(Level<2>&, int);
template void track_inexact_nodes(Level<3>&, int);
template void count_inexact_nodes(Level<2>&);
template void count_inexact_nodes(Level<3>&);
template void count_uses_by_event(Level<2>&, int);
template void count_uses_by_event(Level<3>&, int);

}  // namespace pnpbs
