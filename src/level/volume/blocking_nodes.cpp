// SPDX-License-Identifier: BSD-3-Clause
#include "level/volume/blocking_nodes.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include "comm/records.hpp"
#include "level/finish.hpp"
#include "level/population_events.hpp"
#include "level/volume/boundary_pieces.hpp"
#include "level/volume/loose_pieces.hpp"
#include "level/volume/open_faces.hpp"
#include "level/volume/settled_elements.hpp"

namespace pnpbs {

namespace {

bool is_free(const Level<3>& level, std::int64_t i) {
  return level.nodes.carrier(i) == Carrier::free;
}

// Returns flags of the owned nodes at which the boundary is torn or that lie on a surplus piece of
// it. All ranks must call it, and if one rank throws, all ranks throw.
std::vector<char> nodes_off(const Level<3>& level) {
  const BoundaryPieces pieces = boundary_pieces(level);
  const std::set<std::int64_t> extra = surplus_pieces(level, pieces);
  std::vector<char> off(static_cast<std::size_t>(level.nodes.count), 0);
  collective_try(*level.comm, [&] {
    for_each("pnpbs::nodes_off", level.nodes.count, [&](std::int64_t i) {
      const auto node = static_cast<std::size_t>(i);
      off[node] = is_torn_around(level, i) ||
                  (level.nodes.owned(i) != 0 && extra.contains(pieces.of[node]));
    });
  });
  return off;
}

// Appends the ids of the nodes that block the boundary at this torn node. Other ranks may own them.
void add_blocking_ids(const Level<3>& level, std::int64_t i, std::vector<std::int64_t>& ids) {
  const Nodes<3>& nodes = level.nodes;
  if (is_free(level, i)) {
    ids.push_back(nodes.id(i));
    return;
  }
  bool any = false;
  level.stars.for_neighbours(i, [&](std::int64_t j) {
    if (!is_free(level, j)) return;
    ids.push_back(nodes.id(j));
    any = true;
  });
  if (!any && nodes.carrier(i) == Carrier::surface && open_faces(level, i).empty())
    ids.push_back(nodes.id(i));
}

// Returns the ids of all ranks, ascending and without repetition.
std::vector<std::int64_t> blocking_ids(const Level<3>& level, const std::vector<char>& off) {
  std::vector<std::int64_t> own;
  collective_try(*level.comm, [&] {
    for (std::int64_t i = 0; i < level.nodes.count; ++i)
      if (off[static_cast<std::size_t>(i)] != 0) add_blocking_ids(level, i, own);
  });
  std::vector<std::int64_t> all = of_all_ranks(*level.comm, own);
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

// Returns the ids of the nodes to remove, the same on all ranks. Collective.
std::vector<std::int64_t> ids_to_remove(Level<3>& level, std::int64_t& nodes_off_before) {
  const std::vector<char> off = nodes_off(level);
  const auto count = static_cast<std::int64_t>(level.comm->allreduce_sum(
      static_cast<std::uint64_t>(std::ranges::count_if(off, [](char is) { return is != 0; }))));
  std::vector<std::int64_t> ids;
  if (count == 0) return ids;
  if (count < nodes_off_before) ids = blocking_ids(level, off);
  if (ids.empty()) ids = ids_of_loose_pieces(level);
  if (ids.empty()) ids = ids_of_lone_nodes(level);
  nodes_off_before = std::min(nodes_off_before, count);
  return ids;
}

}  // namespace

std::int64_t remove_blocking_nodes(Level<3>& level, std::int64_t& nodes_off_before) {
  const std::vector<std::int64_t> ids = ids_to_remove(level, nodes_off_before);
  if (ids.empty()) return 0;
  std::vector<std::int32_t> leaving;  // ghosts included
  for (std::int32_t i = 0; i < level.nodes.count; ++i)
    if (std::ranges::binary_search(ids, level.nodes.id(i))) leaving.push_back(i);
  delete_nodes(level, leaving);
  require_finish_lists(level);
  return std::ssize(ids);
}

}  // namespace pnpbs
