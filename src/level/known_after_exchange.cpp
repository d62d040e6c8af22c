// SPDX-License-Identifier: BSD-3-Clause
#include "level/known_after_exchange.hpp"

#include <cstdint>
#include <utility>
#include <vector>

namespace pnpbs {

template <int Dim>
KnownRegion<Dim> known_after_exchange(Level<Dim>& level, int hops) {
  if (!level.distributed()) return {};
  const LevelTree<Dim>& tree = *level.tree;
  const Halo& halo = level.tree->halo(hops, level.settings);
  std::vector<char> known(static_cast<std::size_t>(tree.tree().leaf_count()), 0);
  for (std::int32_t leaf = 0; leaf < tree.tree().leaf_count(); ++leaf) {
    known[static_cast<std::size_t>(leaf)] = tree.owns(leaf) || tree.map().leaf_empty(leaf);
    if (tree.distribution().refined(leaf))
      halo.for_ranks(leaf, [&](int r) {
        if (r == level.comm->rank()) known[static_cast<std::size_t>(leaf)] = 1;
      });
  }
  return KnownRegion<Dim>(tree.tree(), std::move(known));
}

template KnownRegion<2> known_after_exchange(Level<2>&, int);
template KnownRegion<3> known_after_exchange(Level<3>&, int);

}  // namespace pnpbs
