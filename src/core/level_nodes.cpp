// SPDX-License-Identifier: BSD-3-Clause
// The nodes of a new level: filled, or taken over from what there was, and numbered.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "core/initial_fill.hpp"
#include "core/level.hpp"
#include "geometry/keep_off.hpp"
#include "parallel/records.hpp"

namespace pnpbs {

// Nodes that d asks for in each leaf of ours. Of the leaves that the boundary crosses we know only
// what the domain's area leaves for all of them. Collective.
std::vector<double> Level::wanted_nodes() const {
  const BackgroundTree<2>& tree = map_.tree();
  std::uint64_t inside = 0, crossed = 0;  // areas
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf)
    if (distribution_.owns(leaf) && !map_.leaf_outside(leaf))
      (map_.leaf_has_edges(leaf) ? crossed : inside) += map_.leaf_size(leaf);
  const double unit = std::pow(std::ldexp(tree.side(), -DomainMap::kMaxDepth), 2);
  const double area_inside = unit * static_cast<double>(comm_->sum(inside)),
               area_crossed = unit * static_cast<double>(comm_->sum(crossed));
  const double share =
      area_crossed > 0 ? std::clamp((domain_->area() - area_inside) / area_crossed, 0.0, 1.0) : 0;
  std::vector<double> wanted;
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    const double d = map_.leaf_spacing(leaf), side = tree.cell_side(tree.leaf_cell(leaf));
    const double part = !distribution_.owns(leaf) || map_.leaf_outside(leaf) ? 0
                        : map_.leaf_has_edges(leaf)                          ? share
                                                                             : 1;
    wanted.push_back(part > 0 ? part * kHexagonalDensity * side * side / (d * d) : 0);
  }
  return wanted;
}

double Level::expected_nodes() const {
  std::int64_t nodes = 0;
  for (double wanted : wanted_nodes()) nodes += fixed_point(wanted);
  return from_fixed_point(comm_->sum(static_cast<std::uint64_t>(nodes)));
}

// Boundary nodes keep their ids where they stay in place.
void Level::keep_boundary_ids(const std::vector<GivenNode>& given) {
  std::map<Point<2>, std::int64_t> id_at;
  for (const GivenNode& node : given)
    if (!node.inner) id_at[node.position] = node.id;
  for (std::size_t b = 0; b < boundary_.nodes.size() && !id_at.empty(); ++b) {
    const auto found = id_at.find(boundary_.nodes[b].position);
    if (found != id_at.end()) boundary_ids_[b] = found->second;
  }
}

void Level::fill() {
  const PhaseTimer timer(timers_, Phase::fill);
  std::vector<GivenNode> inner;
  const std::vector<LeafSummary> unrefined = summaries_of_unrefined_leaves();
  agreed(*comm_, [&] {
    for (const Point<2>& x : hexagonal_fill(map_, domain_->bounds(), owns_leaf(), unrefined))
      inner.push_back({x, -1});
  });
  number_and_store(std::move(inner));
}

// Where the tree is not refined here, the owners of the cells tell what is in them.
std::vector<LeafSummary> Level::summaries_of_unrefined_leaves() const {
  if (!distributed()) return {};
  const PartitionCells& cells = distribution_.cells();
  const BackgroundTree<2>& tree = map_.tree();
  const std::vector<SpacingSummary> own = spacing_summaries(map_, {});
  struct CellSummary {
    std::int32_t cell;
    SpacingSummary spacing;
  };
  Bytes mine;
  for (std::int32_t c = 0; c < cells.count(); ++c) {
    if (distribution_.owner_of_cell(c) != comm_->rank()) continue;
    const std::int32_t cell = cells.tree().leaf_cell(c);
    const std::int32_t here =
        tree.cell_at(cells.tree().cell_centre(cell), cells.tree().cell(cell).depth);
    pack(mine, CellSummary{c, own[static_cast<std::size_t>(here)]});
  }
  std::vector<SpacingSummary> summaries(static_cast<std::size_t>(cells.count()));
  for_records<CellSummary>({comm_->gather(mine)}, [&](const CellSummary& summary) {
    summaries[static_cast<std::size_t>(summary.cell)] = summary.spacing;
  });
  std::vector<LeafSummary> unrefined;
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf)
    if (!distribution_.refined(leaf))
      unrefined.push_back({leaf, summaries[static_cast<std::size_t>(distribution_.cell_of(leaf))]});
  return unrefined;
}

TakenNodes Level::take(std::vector<GivenNode> given, std::int64_t next_id) {
  const PhaseTimer timer(timers_, Phase::fill);
  next_id_ = next_id;
  scatter_to_owners(given);
  keep_boundary_ids(given);
  std::vector<GivenNode> inner;
  std::uint64_t left_out = 0;
  for (const GivenNode& node : given) {
    if (!node.inner) continue;
    if (fits(node.position, map_.leaf_spacing(map_.tree().leaf_at(node.position))))
      inner.push_back(node);
    else
      ++left_out;
  }
  const std::uint64_t before = inner.size();
  thin(inner);
  const std::uint64_t thinned = before - inner.size();
  number_and_store(std::move(inner));
  return {static_cast<std::int64_t>(comm_->sum(left_out)),
          static_cast<std::int64_t>(comm_->sum(thinned))};
}

// Where nodes are many times too dense for d, because d has grown since they were placed or because
// they were given so, contests would take long to delete them. Each then counts for the share that
// should stay, and along the Morton order of the leaves a node stays whenever the sum of the shares
// passes a whole number.
void Level::thin(std::vector<GivenNode>& inner) const {
  constexpr double kCrowded = 1.5;  // times the nodes that d asks for in a leaf, and a few
  constexpr std::int64_t kOne = std::int64_t{1} << 32;
  const BackgroundTree<2>& tree = map_.tree();
  const auto leaf_of = [&](const GivenNode& node) {
    return static_cast<std::size_t>(tree.leaf_at(node.position));
  };
  const std::vector<double> wanted = wanted_nodes();
  std::vector<double> given_in(static_cast<std::size_t>(tree.leaf_count()), 0);
  for (const GivenNode& node : inner) given_in[leaf_of(node)] += 1;
  const auto share_of = [&](const GivenNode& node) {
    const std::size_t leaf = leaf_of(node);
    const double d = map_.leaf_spacing(static_cast<std::int32_t>(leaf));
    double share = 1;
    if (node.d > 0 && d > 1.02 * node.d) share = (node.d / d) * (node.d / d);
    if (given_in[leaf] > kCrowded * wanted[leaf] + 4)
      share = std::min(share, wanted[leaf] / given_in[leaf]);
    return static_cast<std::int64_t>(share * static_cast<double>(kOne));
  };
  std::sort(inner.begin(), inner.end(), [&](const GivenNode& a, const GivenNode& b) {
    return std::make_tuple(leaf_of(a), a.position[1], a.position[0], a.id) <
           std::make_tuple(leaf_of(b), b.position[1], b.position[0], b.id);
  });
  std::vector<std::int64_t> sums(given_in.size(), 0);
  for (const GivenNode& node : inner) sums[leaf_of(node)] += share_of(node);
  std::int64_t end = 0;
  std::vector<std::int64_t> sum_before = distribution_.prefix_sums(*comm_, std::move(sums), end);
  std::erase_if(inner, [&](const GivenNode& node) {
    std::int64_t& sum = sum_before[leaf_of(node)];
    const std::int64_t whole = sum / kOne;
    sum += share_of(node);
    return sum / kOne == whole;
  });
}

// New ids go by bucket in Morton order, boundary nodes first, then by place, so that the order of
// ids is nearly the order in memory.
void Level::number_and_store(std::vector<GivenNode> inner) {
  ++version_;
  struct Entry {
    std::int32_t leaf;
    std::int32_t boundary_node;  // the number of boundary nodes for an inner one
    Point<2> x;
    std::int64_t id;
    bool operator<(const Entry& other) const {
      return std::tie(leaf, boundary_node, x[1], x[0], id) <
             std::tie(other.leaf, other.boundary_node, other.x[1], other.x[0], other.id);
    }
  };
  const BackgroundTree<2>& tree = map_.tree();
  const std::int32_t boundary_count = static_cast<std::int32_t>(boundary_.nodes.size());
  std::vector<Entry> entries;
  for (std::int32_t b = 0; b < boundary_count; ++b) {
    const Point<2>& x = boundary_.nodes[static_cast<std::size_t>(b)].position;
    const std::int32_t leaf = tree.leaf_at(x);
    if (distribution_.owns(leaf))
      entries.push_back({leaf, b, x, boundary_ids_[static_cast<std::size_t>(b)]});
  }
  double most_id = static_cast<double>(next_id_ - 1);
  for (const GivenNode& node : inner) {
    entries.push_back({tree.leaf_at(node.position), boundary_count, node.position, node.id});
    most_id = std::max(most_id, static_cast<double>(node.id));
  }
  next_id_ = static_cast<std::int64_t>(comm_->largest(most_id)) + 1;
  std::sort(entries.begin(), entries.end());
  // Nodes in one place would never part: the first of them counts.
  entries.erase(std::unique(entries.begin(), entries.end(),
                            [](const Entry& a, const Entry& b) { return a.x == b.x; }),
                entries.end());

  std::vector<std::int64_t> new_ids(static_cast<std::size_t>(tree.leaf_count()), 0);
  for (const Entry& entry : entries) new_ids[static_cast<std::size_t>(entry.leaf)] += entry.id < 0;
  std::vector<std::int64_t> next = distribution_.prefix_sums(*comm_, std::move(new_ids), next_id_);

  nodes_.count = 0;
  in_buckets_ = false;
  nodes_.reserve(static_cast<std::int64_t>(entries.size() + entries.size() / 64) + 64);
  for (const Entry& entry : entries) {
    const std::int64_t id = entry.id >= 0 ? entry.id : next[static_cast<std::size_t>(entry.leaf)]++;
    const bool inner_node = entry.boundary_node == boundary_count;
    nodes_.append(
        entry.x, 1, id,
        inner_node ? 0 : boundary_.nodes[static_cast<std::size_t>(entry.boundary_node)].tag,
        inner_node ? -1 : entry.boundary_node);
  }
  refresh_spacing();
  exchange(step_hops());
}

bool Level::fits(const Point<2>& x, double d) const {
  const Box<2>& box = domain_->bounds();
  for (int k = 0; k < 2; ++k)
    if (!(x[k] > box.low[k] && x[k] < box.high[k])) return false;
  return map_.inside(x) && map_.clearance(x, kBoundaryClearance * d) >= kBoundaryClearance * d;
}

}  // namespace pnpbs
