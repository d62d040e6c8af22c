// SPDX-License-Identifier: BSD-3-Clause
#include "level/thinning.hpp"

#include <algorithm>

#include "base/fixed_point.hpp"
#include "level/expected_nodes.hpp"
#include "level/numbering.hpp"
#include "method/constants.hpp"

namespace pnpbs {

namespace {

// Returns the fraction of nodes to keep in M dimensions, of those that were placed for the smaller
// spacing of `node`.
template <int M, int Dim>
double share_for(const IncomingNode<Dim>& node, double d) {
  return node.d > 0 && d > method::kThinnedAbove * node.d ? power<M>(node.d / d) : 1;
}

// Thins nodes to their shares. Along the Morton order of the leaves, a node is kept whenever the
// sum of the shares passes a whole number.
template <int Dim, class Share>
void keep_shares(const Level<Dim>& level, IncomingNodes<Dim>& incoming,
                 const std::vector<std::int32_t>& begin, const Share& share) {
  constexpr std::int64_t kOne = kFixedPointOne;
  const std::int32_t leaves = level.map().tree().leaf_count();
  const auto share_of = [&](const IncomingNode<Dim>& node) {
    return static_cast<std::int64_t>(share(node) * static_cast<double>(kOne));
  };
  const auto for_nodes_in = [&](std::int64_t leaf, const auto& visit) {
    const auto at = static_cast<std::size_t>(leaf);
    for (std::int32_t k = begin[at]; k < begin[at + 1]; ++k)
      visit(incoming[static_cast<std::size_t>(k)]);
  };
  std::vector<std::int64_t> sums(static_cast<std::size_t>(leaves), 0);
  for_each("pnpbs::sum_shares", leaves, [&](std::int64_t leaf) {
    for_nodes_in(leaf, [&](const IncomingNode<Dim>& node) {
      sums[static_cast<std::size_t>(leaf)] += share_of(node);
    });
  });
  std::int64_t end = 0;
  sums = level.tree->distribution().prefix_sums(*level.comm, std::move(sums), end);
  std::vector<char> some_go(static_cast<std::size_t>(leaves), 0);
  for_each("pnpbs::thin", leaves, [&](std::int64_t leaf) {
    const auto at = static_cast<std::size_t>(leaf);
    std::int64_t sum = fraction_of(sums[at]);
    for_nodes_in(leaf, [&](IncomingNode<Dim>& node) {
      const std::int64_t whole = sum / kOne;
      sum += share_of(node);
      if (sum / kOne != whole) return;
      node.leaf = -1;
      some_go[at] = 1;
    });
  });
  if (std::find(some_go.begin(), some_go.end(), 1) != some_go.end())
    std::erase_if(incoming, [](const IncomingNode<Dim>& node) { return node.leaf < 0; });
}

}  // namespace

template <int Dim>
void thin(const Level<Dim>& level, IncomingNodes<Dim>& inner,
          const std::vector<std::int32_t>& begin) {
  const std::vector<double> wanted = wanted_nodes(level);
  keep_shares(level, inner, begin, [&](const IncomingNode<Dim>& node) {
    const auto leaf = static_cast<std::size_t>(node.leaf);
    const double given = begin[leaf + 1] - begin[leaf],
                 share = share_for<Dim>(node, level.map().leaf_spacing(node.leaf));
    if (given > method::kCrowdedLeaf * wanted[leaf] + method::kCrowdedLeafMore)
      return std::min(share, wanted[leaf] / given);
    return share;
  });
}

void thin_on_surfaces(const Level<3>& level, IncomingNodes<3>& on_surfaces) {
  for (IncomingNode<3>& node : on_surfaces) node.leaf = level.tree->tree().leaf_at(node.position);
  const std::vector<std::int32_t> begin = sort_by_leaf(level, on_surfaces);
  keep_shares(level, on_surfaces, begin, [&](const IncomingNode<3>& node) {
    return share_for<2>(node, level.map().leaf_spacing(node.leaf));
  });
}

template void thin(const Level<2>&, IncomingNodes<2>&, const std::vector<std::int32_t>&);
template void thin(const Level<3>&, IncomingNodes<3>&, const std::vector<std::int32_t>&);

}  // namespace pnpbs
