// SPDX-License-Identifier: BSD-3-Clause
#include "tool/gathered_nodes.hpp"

#include <algorithm>
#include <array>

namespace pnpbs::tool {
namespace {

struct Node {
  std::int64_t id;
  double x, y, spacing;
  std::int64_t tag;
};

using Corners = std::array<std::int64_t, 3>;

std::vector<Node> own_nodes(pnpbs_placement placement, pnpbs_context context) {
  std::int64_t count = 0;
  check(pnpbs_placement_count(placement, &count), context);
  const auto size = static_cast<std::size_t>(count);
  std::vector<double> xy(2 * size), spacing(size);
  std::vector<std::int64_t> ids(size);
  std::vector<std::int32_t> tags(size);
  check(pnpbs_placement_get_nodes(placement, count, xy.data(), ids.data(), tags.data(),
                                  spacing.data()),
        context);
  std::vector<Node> nodes(size);
  for (std::size_t i = 0; i < size; ++i)
    nodes[i] = {ids[i], xy[2 * i], xy[2 * i + 1], spacing[i], tags[i]};
  return nodes;
}

std::vector<std::int64_t> ghost_ids(pnpbs_placement placement, pnpbs_context context) {
  std::int64_t count = 0;
  check(pnpbs_placement_ghost_count(placement, &count), context);
  std::vector<std::int64_t> ids(static_cast<std::size_t>(count));
  check(
      pnpbs_placement_get_ghosts(placement, count, nullptr, ids.data(), nullptr, nullptr, nullptr),
      context);
  return ids;
}

// By the ids of their corners.
std::vector<Corners> own_triangles(pnpbs_placement placement, pnpbs_context context,
                                   const std::vector<Node>& nodes) {
  const std::vector<std::int64_t> ghosts = ghost_ids(placement, context);
  std::int64_t count = 0;
  check(pnpbs_placement_get_triangles(placement, 0, &count, nullptr), context);
  std::vector<Corners> triangles(static_cast<std::size_t>(count));
  check(pnpbs_placement_get_triangles(placement, count, &count,
                                      triangles.empty() ? nullptr : triangles[0].data()),
        context);
  for (Corners& corners : triangles) {
    for (std::int64_t& corner : corners) {
      const auto i = static_cast<std::size_t>(corner);
      corner = i < nodes.size() ? nodes[i].id : ghosts[i - nodes.size()];
    }
  }
  return triangles;
}

// In the order of their ids, whoever had them.
void take_nodes(std::vector<Node> nodes, picture::NodeSet& set) {
  std::ranges::sort(nodes, {}, &Node::id);
  set.xy.reserve(2 * nodes.size());
  set.ids.reserve(nodes.size());
  set.tags.reserve(nodes.size());
  set.spacing.reserve(nodes.size());
  for (const Node& node : nodes) {
    set.xy.insert(set.xy.end(), {node.x, node.y});
    set.ids.push_back(node.id);
    set.tags.push_back(static_cast<std::int32_t>(node.tag));
    set.spacing.push_back(node.spacing);
  }
}

void take_triangles(std::vector<Corners> triangles, picture::NodeSet& set) {
  std::ranges::sort(triangles);
  for (Corners& corners : triangles) {
    for (std::int64_t& corner : corners)
      corner = std::ranges::lower_bound(set.ids, corner) - set.ids.begin();
  }
  set.triangles = std::move(triangles);
}

}  // namespace

picture::NodeSet gathered_nodes(pnpbs_placement placement, pnpbs_context context,
                                const Ranks& ranks) {
  std::vector<Node> own;
  ranks.agreed([&] { own = own_nodes(placement, context); });
  std::vector<Corners> triangles = own_triangles(placement, context, own);
  picture::NodeSet set;
  take_nodes(ranks.gather(std::move(own)), set);
  take_triangles(ranks.gather(std::move(triangles)), set);
  return set;
}

}  // namespace pnpbs::tool
