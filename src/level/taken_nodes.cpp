// SPDX-License-Identifier: BSD-3-Clause
// Nodes that a level takes over, wherever they come from: sent to their owners, thinned where they
// are too dense, and numbered.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

#include "base/counting_sort.hpp"
#include "comm/records.hpp"
#include "domain/clearance.hpp"
#include "initial/graded_fill.hpp"
#include "initial/initial_fill.hpp"
#include "level/level.hpp"

namespace pnpbs {

// Boundary nodes keep their ids where they stay in place.
void Level::keep_boundary_ids(const GivenNodes& given) {
  std::map<Point<2>, std::int64_t> id_at;
  for (const GivenNode& node : given)
    if (!node.inner && node.id >= 0) id_at[node.position] = node.id;
  for (std::size_t b = 0; b < boundary_.nodes.size() && !id_at.empty(); ++b) {
    const auto found = id_at.find(boundary_.nodes[b].position);
    if (found != id_at.end()) boundary_ids_[b] = found->second;
  }
}

TakenNodes Level::take(GivenNodes given, std::int64_t next_id) {
  const PhaseTimer timer(timers_, Phase::fill);
  const auto count_if = [&](const auto& counts) {
    return sum_of("pnpbs::Level::take", static_cast<std::int64_t>(given.size()),
                  [&](std::int64_t k) { return counts(given[static_cast<std::size_t>(k)]); });
  };
  next_id_ = next_id;
  scatter_to_owners(given);
  keep_boundary_ids(given);
  const std::uint64_t all = count_if([](const GivenNode& node) { return node.inner; });
  find_leaves(given);
  leave_out_those_without_place(given);
  const std::vector<std::int32_t> begin = sort_by_place(given);
  const std::uint64_t fitting = given.size();
  thin(given, begin);
  const std::uint64_t taken = given.size(),
                      numbered = count_if([](const GivenNode&node) { return node.id < 0; });
  number_and_store(std::move(given));
  return {static_cast<std::int64_t>(comm_->allreduce_sum(all - fitting)),
          static_cast<std::int64_t>(comm_->allreduce_sum(fitting - taken)),
          static_cast<std::int64_t>(comm_->allreduce_sum(numbered))};
}

// Of inner nodes; a boundary node has none, it is laid afresh.
void Level::find_leaves(GivenNodes& given) const {
  for_each("pnpbs::Level::find_leaves", static_cast<std::int64_t>(given.size()),
           [&](std::int64_t k) {
             GivenNode& node = given[static_cast<std::size_t>(k)];
             node.leaf = node.inner ? map_.tree().leaf_at(node.position) : -1;
           });
}

void Level::leave_out_those_without_place(GivenNodes& given) const {
  for_each("pnpbs::Level::has_place", static_cast<std::int64_t>(given.size()), [&](std::int64_t k) {
    GivenNode& node = given[static_cast<std::size_t>(k)];
    if (node.leaf >= 0 && !has_place(node)) node.leaf = -1;
  });
}

// In the domain, and not too close to its boundary.
bool Level::has_place(const GivenNode& node) const {
  if (near_edges_.leaf_is_clear(node.leaf)) return !map_.leaf_outside(node.leaf);
  return has_clearance(node.position, map_.leaf_spacing(node.leaf));
}

// By leaf, in Morton order, and by place within it, so that nothing depends on where nodes came
// from; those that have no leaf are left out. Returns the first place of each leaf.
std::vector<std::int32_t> Level::sort_by_place(GivenNodes& given) const {
  const std::int32_t leaves = map_.tree().leaf_count();
  const auto leaf_of = [&](std::int64_t k) { return given[static_cast<std::size_t>(k)].leaf; };
  CountingSort by_leaf(static_cast<std::int64_t>(given.size()), leaves, leaf_of);
  std::vector<std::int32_t> begin = by_leaf.start();
  GivenNodes sorted(static_cast<std::size_t>(begin.back()));
  by_leaf.for_places(leaf_of, [&](std::int64_t k, std::int32_t place) {
    sorted[static_cast<std::size_t>(place)] = given[static_cast<std::size_t>(k)];
  });
  given = std::move(sorted);
  for_each("pnpbs::Level::sort_by_place", leaves, [&](std::int64_t leaf) {
    const auto at = static_cast<std::size_t>(leaf);
    std::sort(given.begin() + begin[at], given.begin() + begin[at + 1],
              [](const GivenNode& a, const GivenNode& b) {
                return std::tie(a.position[1], a.position[0], a.id, a.d) <
                       std::tie(b.position[1], b.position[0], b.id, b.d);
              });
  });
  return begin;
}

// Where nodes are many times too dense for d, because d has grown since they were placed or because
// they were given so, contests would take long to delete them. Each then counts for the share that
// should stay, and along the Morton order of the leaves a node stays whenever the sum of the shares
// passes a whole number. The nodes are sorted by place, and `begin` is each leaf's first.
void Level::thin(GivenNodes& inner, const std::vector<std::int32_t>& begin) const {
  constexpr double kCrowded = 1.5;  // times the nodes that d asks for in a leaf, and a few
  constexpr std::int64_t kOne = std::int64_t{1} << 32;
  const std::vector<double> wanted = wanted_nodes();
  const std::int32_t leaves = map_.tree().leaf_count();
  const auto share_of = [&](const GivenNode& node) {
    const auto leaf = static_cast<std::size_t>(node.leaf);
    const double d = map_.leaf_spacing(node.leaf), given = begin[leaf + 1] - begin[leaf];
    double share = 1;
    if (node.d > 0 && d > 1.02 * node.d) share = (node.d / d) * (node.d / d);
    if (given > kCrowded * wanted[leaf] + 4) share = std::min(share, wanted[leaf] / given);
    return static_cast<std::int64_t>(share * static_cast<double>(kOne));
  };
  const auto for_nodes_in = [&](std::int64_t leaf, const auto& visit) {
    const auto at = static_cast<std::size_t>(leaf);
    for (std::int32_t k = begin[at]; k < begin[at + 1]; ++k)
      visit(inner[static_cast<std::size_t>(k)]);
  };
  std::vector<std::int64_t> sums(static_cast<std::size_t>(leaves), 0);
  for_each("pnpbs::Level::sum_shares", leaves, [&](std::int64_t leaf) {
    for_nodes_in(leaf, [&](const GivenNode& node) {
      sums[static_cast<std::size_t>(leaf)] += share_of(node);
    });
  });
  std::int64_t end = 0;
  sums = distribution_.prefix_sums(*comm_, std::move(sums), end);
  const std::uint64_t gone = sum_of("pnpbs::Level::thin", leaves, [&](std::int64_t leaf) {
    std::int64_t sum = sums[static_cast<std::size_t>(leaf)], in_leaf = 0;
    for_nodes_in(leaf, [&](GivenNode& node) {
      const std::int64_t whole = sum / kOne;
      sum += share_of(node);
      if (sum / kOne != whole) return;
      node.leaf = -1;
      ++in_leaf;
    });
    return in_leaf;
  });
  if (gone > 0) std::erase_if(inner, [](const GivenNode& node) { return node.leaf < 0; });
}

namespace {

struct LeafNode {
  std::int32_t leaf, node;  // of the boundary
};

// Boundary and inner nodes, both sorted by leaf, as they follow each other: leaf by leaf, boundary
// nodes first. All threads walk along them, each in its own blocks of leaves.
class LeafBlocks {
 public:
  LeafBlocks(std::int32_t leaves, const std::vector<LeafNode>& boundary, const GivenNodes& inner)
      : leaves_(leaves), boundary_(boundary), inner_(inner) {}

  // Calls of_boundary(place, node) or of_inner(place, node) for every node.
  template <class OfBoundary, class OfInner>
  void for_each_node(const OfBoundary& of_boundary, const OfInner& of_inner) const {
    constexpr std::int32_t kBlock = 256;
    for_each("pnpbs::LeafBlocks", (leaves_ + kBlock - 1) / kBlock, [&](std::int64_t block) {
      const auto first = static_cast<std::int32_t>(block) * kBlock;
      const auto before = [](const auto& node, std::int32_t leaf) { return node.leaf < leaf; };
      const auto place_of = [&](const auto& nodes) {
        return static_cast<std::size_t>(
            std::lower_bound(nodes.begin(), nodes.end(), first, before) - nodes.begin());
      };
      std::size_t b = place_of(boundary_), k = place_of(inner_);
      for (std::int32_t leaf = first; leaf < std::min(first + kBlock, leaves_); ++leaf) {
        for (; b < boundary_.size() && boundary_[b].leaf == leaf; ++b)
          of_boundary(b + k, boundary_[b]);
        for (; k < inner_.size() && inner_[k].leaf == leaf; ++k) of_inner(b + k, inner_[k]);
      }
    });
  }

 private:
  std::int32_t leaves_;
  const std::vector<LeafNode>& boundary_;
  const GivenNodes& inner_;
};

}  // namespace

// Nodes in one place would never part: the first of them counts. They are sorted by place.
void Level::leave_out_coinciding(GivenNodes& inner) const {
  const auto same_place = [](const GivenNode& a, const GivenNode& b) {
    return a.position == b.position;
  };
  const std::int64_t pairs = std::max<std::int64_t>(1, static_cast<std::int64_t>(inner.size())) - 1;
  const std::uint64_t coinciding = sum_of("pnpbs::Level::coinciding", pairs, [&](std::int64_t n) {
    const auto k = static_cast<std::size_t>(n);
    return same_place(inner[k], inner[k + 1]);
  });
  if (coinciding > 0) inner.erase(std::unique(inner.begin(), inner.end(), same_place), inner.end());
}

// New ids go by bucket in Morton order, boundary nodes first, then by place, so that the order of
// ids is nearly the order in memory. The nodes are sorted by place.
void Level::number_and_store(GivenNodes inner) {
  ++version_;
  leave_out_coinciding(inner);
  const double most_id = largest_of(
      "pnpbs::Level::most_id", static_cast<std::int64_t>(inner.size()),
      static_cast<double>(next_id_ - 1),
      [&](std::int64_t k) { return static_cast<double>(inner[static_cast<std::size_t>(k)].id); });
  next_id_ = static_cast<std::int64_t>(comm_->allreduce_max(most_id)) + 1;

  std::vector<LeafNode> own_boundary;
  for (std::size_t b = 0; b < boundary_.nodes.size(); ++b) {
    const std::int32_t leaf = map_.tree().leaf_at(boundary_.nodes[b].position);
    if (distribution_.owns(leaf)) own_boundary.push_back({leaf, static_cast<std::int32_t>(b)});
  }
  std::sort(own_boundary.begin(), own_boundary.end(), [](const LeafNode& a, const LeafNode& b) {
    return std::tie(a.leaf, a.node) < std::tie(b.leaf, b.node);
  });
  const LeafBlocks blocks(map_.tree().leaf_count(), own_boundary, inner);

  std::vector<std::int64_t> next(static_cast<std::size_t>(map_.tree().leaf_count()), 0);
  const auto boundary_id = [&](const LeafNode& node) {
    return boundary_ids_[static_cast<std::size_t>(node.node)];
  };
  blocks.for_each_node(
      [&](std::size_t, const LeafNode& node) {
        next[static_cast<std::size_t>(node.leaf)] += boundary_id(node) < 0;
      },
      [&](std::size_t, const GivenNode& node) {
        next[static_cast<std::size_t>(node.leaf)] += node.id < 0;
      });
  next = distribution_.prefix_sums(*comm_, std::move(next), next_id_);
  const auto number = [&](std::int64_t id, std::int32_t leaf) {
    return id >= 0 ? id : next[static_cast<std::size_t>(leaf)]++;
  };
  const std::size_t count = own_boundary.size() + inner.size();
  nodes_.count = 0;
  // For births and, over several ranks, for ghosts.
  nodes_.reserve(static_cast<std::int64_t>(count + count / (distributed() ? 16 : 64)) + 64);
  nodes_.count = static_cast<std::int64_t>(count);
  const View<std::int32_t> bucket = buckets_.buckets_of_new(nodes_);
  blocks.for_each_node(
      [&](std::size_t place, const LeafNode& node) {
        const auto i = static_cast<std::int64_t>(place);
        const BoundaryNode& laid = boundary_.nodes[static_cast<std::size_t>(node.node)];
        nodes_.put(i, laid.position, 1, number(boundary_id(node), node.leaf), laid.tag, node.node);
        bucket(i) = node.leaf;
      },
      [&](std::size_t place, const GivenNode& node) {
        const auto i = static_cast<std::int64_t>(place);
        nodes_.put(i, node.position, 1, number(node.id, node.leaf), 0, -1);
        bucket(i) = node.leaf;
      });
  refresh_spacing();
  exchange(step_hops());
}

bool Level::has_clearance(const Point<2>& x, double d) const {
  const Box<2>& box = domain_->bounds();
  for (int k = 0; k < 2; ++k)
    if (!(x[k] > box.low[k] && x[k] < box.high[k])) return false;
  return map_.inside(x) && map_.clearance(x, kBoundaryClearance * d) >= kBoundaryClearance * d;
}

}  // namespace pnpbs
