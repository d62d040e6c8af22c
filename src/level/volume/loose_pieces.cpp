// SPDX-License-Identifier: BSD-3-Clause
#include "level/volume/loose_pieces.hpp"

#include <algorithm>
#include <utility>

#include "base/index.hpp"
#include "comm/records.hpp"
#include "level/volume/settled_elements.hpp"
#include "method/constants.hpp"

namespace pnpbs {

namespace {

// A node on a surplus piece of the boundary.
struct PieceNode {
  std::int64_t piece, id;
  Point<3> x;
  double d;
  std::int64_t on_feature;  // 1 if the node lies on a feature, else 0
};

// A node without elements.
struct LoneNode {
  std::int64_t id, on_feature;
};

bool is_on_feature(Carrier carrier) {
  return carrier == Carrier::fixed || carrier == Carrier::curve;
}

// Returns the nodes of all surplus pieces of all ranks, sorted by piece and id. All ranks must call
// it, and if one rank throws, all ranks throw.
std::vector<PieceNode> nodes_of_surplus_pieces(const Level<3>& level) {
  const BoundaryPieces pieces = boundary_pieces(level);
  const Nodes<3>& nodes = level.nodes;
  std::vector<PieceNode> own;
  collective_try(*level.comm, [&] {
    const std::set<std::int64_t> extra = surplus_pieces(level, pieces);
    for (std::int64_t i = 0; i < nodes.count; ++i)
      if (const std::int64_t piece = pieces.of[static_cast<std::size_t>(i)];
          nodes.owned(i) != 0 && extra.contains(piece))
        own.push_back(
            {piece, nodes.id(i), nodes.position(i), nodes.d(i), is_on_feature(nodes.carrier(i))});
  });
  std::vector<PieceNode> all = of_all_ranks(*level.comm, own);
  std::ranges::sort(all, {}, [](const PieceNode& node) { return std::pair(node.piece, node.id); });
  return all;
}

bool is_given(const Level<3>& level, const Point<3>& x) {
  return std::ranges::any_of(level.geometry.domain().fixed_nodes(),
                             [&](const FixedNode<3>& node) { return node.position == x; });
}

// Returns whether the nodes of one piece are so close together that the piece is removed.
template <class Iterator>
bool is_loose(const Level<3>& level, Iterator begin, Iterator end) {
  return std::all_of(begin, end, [&](const PieceNode& node) {
    return distance<3>(node.x, begin->x) < method::kSmallPiece * begin->d &&
           !is_given(level, node.x);
  });
}

bool has_elements(const Level<3>& level, std::int64_t i) { return level.stars.size(i) > 0; }

// Returns the nodes of all ranks on surfaces that bound the domain which are no corner of an
// element, by ascending id. All ranks must call it, and if one rank throws, all ranks throw.
std::vector<LoneNode> lone_nodes(const Level<3>& level) {
  const Nodes<3>& nodes = level.nodes;
  std::vector<LoneNode> own;
  collective_try(*level.comm, [&] {
    for (std::int64_t i = 0; i < nodes.count; ++i)
      if (nodes.owned(i) != 0 && !has_elements(level, i) && disks_of_surfaces(level, i) > 0 &&
          !is_given(level, nodes.position(i)))
        own.push_back({nodes.id(i), is_on_feature(nodes.carrier(i))});
  });
  std::vector<LoneNode> all = of_all_ranks(*level.comm, own);
  std::ranges::sort(all, {}, &LoneNode::id);
  return all;
}

// Returns for each of them 1 if a node with elements is beside it, and 0 otherwise. Collective.
std::vector<std::int64_t> beside_elements(const Level<3>& level,
                                          const std::vector<LoneNode>& lone) {
  const Nodes<3>& nodes = level.nodes;
  std::vector<std::int64_t> beside(lone.size(), 0);
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    if (nodes.owned(i) == 0 || !has_elements(level, i)) continue;
    level.lists().for_neighbours(i, [&](std::int64_t j) {
      const auto found = std::ranges::lower_bound(lone, nodes.id(j), {}, &LoneNode::id);
      if (found != lone.end() && found->id == nodes.id(j) &&
          distance<3>(nodes.position(i), nodes.position(j)) < method::kBeside * nodes.d(j))
        beside[static_cast<std::size_t>(found - lone.begin())] = 1;
    });
  }
  level.comm->allreduce_sum(beside);
  return beside;
}

}  // namespace

std::set<std::int64_t> surplus_pieces(const Level<3>& level, const BoundaryPieces& pieces) {
  if (level.geometry.cell().any()) return {};  // the surfaces are those of several copies
  std::vector<std::pair<std::int64_t, std::int64_t>> by_size;
  for (const auto& [piece, nodes] : pieces.nodes) by_size.emplace_back(nodes, piece);
  std::ranges::sort(by_size);
  const std::int64_t extra = std::ssize(by_size) - pieces_of_surfaces(level);
  std::set<std::int64_t> found;
  for (std::int64_t k = 0; k < extra; ++k)
    found.insert(by_size[static_cast<std::size_t>(k)].second);
  return found;
}

std::vector<std::int64_t> ids_of_loose_pieces(Level<3>& level) {
  const std::vector<PieceNode> all = nodes_of_surplus_pieces(level);
  std::vector<std::int64_t> ids;
  for (auto begin = all.begin(); begin != all.end();) {
    const auto end = std::find_if(
        begin, all.end(), [&](const PieceNode& node) { return node.piece != begin->piece; });
    if (is_loose(level, begin, end))
      for (auto node = begin; node != end; ++node) {
        ids.push_back(node->id);
        level.left_out += node->on_feature;
      }
    begin = end;
  }
  std::ranges::sort(ids);
  return ids;
}

std::vector<std::int64_t> ids_of_lone_nodes(Level<3>& level) {
  std::vector<std::int64_t> ids;
  if (level.held_rounds < method::kRoundsBeforeTips) return ids;
  const std::vector<LoneNode> lone = lone_nodes(level);
  if (lone.empty()) return ids;
  const std::vector<std::int64_t> beside = beside_elements(level, lone);
  for (std::size_t k = 0; k < lone.size(); ++k) {
    if (beside[k] == 0) continue;
    ids.push_back(lone[k].id);
    level.left_out += lone[k].on_feature;
  }
  return ids;
}

FoundNodes<3> features_left_out(const Level<3>& level) {
  FoundNodes<3> found;
  if (level.left_out == 0) return found;
  const Nodes<3>& nodes = level.nodes;
  std::vector<std::int32_t> own;
  for (std::int64_t i = 0; i < nodes.count; ++i)
    if (nodes.owned(i) != 0 && is_on_feature(nodes.carrier(i)))
      own.push_back(nodes.boundary_node(i));
  const std::vector<std::int32_t> present = of_all_ranks(*level.comm, own);
  const std::set<std::int32_t> there(present.begin(), present.end());
  const std::vector<FeatureNode>& laid = level.geometry.features().nodes;
  for (std::int32_t f = 0; f < std::ssize(laid); ++f)
    if (!there.contains(f)) found.add(1, f, laid[index(f)].position);
  return found;
}

}  // namespace pnpbs
