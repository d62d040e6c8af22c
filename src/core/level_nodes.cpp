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
    find_leaves(inner);
    sort_by_place(inner);
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

namespace {

// Into how many pieces of length d a length is cut; one that is long by 1.4 is halved.
int pieces_of(double length, double d) { return static_cast<int>(length / d + 0.6); }

// New nodes on the edge from x to y, cut into equal pieces: so many where it is long enough.
void cut_edge(const Point<2>& x, const Point<2>& y, double d, int most,
              std::vector<GivenNode>& nodes) {
  const int pieces = std::min(most, pieces_of(distance<2>(x, y), d));
  for (int k = 1; k < pieces; ++k) {
    const double a = static_cast<double>(k) / pieces;
    nodes.push_back({{x[0] + a * (y[0] - x[0]), x[1] + a * (y[1] - x[1])}, -1, true, -1, d});
  }
}

// New nodes within a triangle whose edges are cut into three pieces or more.
void fill_triangle(const std::array<Point<2>, 3>& x, double d, int most,
                   std::vector<GivenNode>& nodes) {
  const double around = distance<2>(x[0], x[1]) + distance<2>(x[1], x[2]) + distance<2>(x[2], x[0]);
  const int pieces = std::min(most, pieces_of(around / 3, d));
  for (int a = 1; a < pieces - 1; ++a)
    for (int b = 1; b < pieces - a; ++b) {
      Point<2> y;
      for (int k = 0; k < 2; ++k)
        y[k] = x[0][k] + (a * (x[1][k] - x[0][k]) + b * (x[2][k] - x[0][k])) / pieces;
      nodes.push_back({y, -1, true, -1, d});
    }
}

}  // namespace

std::vector<GivenNode> Level::refined(const Spacing<2>& next) {
  drop_anchors();
  exchange(kStarHops);
  make_lists_and_stars(kStarHops, settings_.list_radius, 0);
  std::vector<GivenNode> nodes = owned_nodes();
  const std::vector<double> spacing = spacing_at_owned_nodes(next);
  agreed(*comm_, [&] {
    std::size_t owned = 0;
    for (std::int64_t i = 0; i < nodes_.count; ++i) {
      if (!nodes_.owned(i)) continue;
      const double d = spacing[owned++];
      // By the spacings, not by lengths: then nearly every node keeps its number of neighbours.
      const int pieces = pieces_of(nodes_.d(i), d);
      if (pieces < 2) continue;
      // Edges and triangles are their node's with the least id.
      const Point<2> x = nodes_.position(i);
      stars_.for_neighbours(i, [&](std::int64_t j, bool) {
        if (nodes_.id(i) < nodes_.id(j) && !on_one_edge(i, j))
          cut_edge(x, nodes_.position(j), d, pieces, nodes);
      });
      stars_.for_triangles(i, [&](std::int64_t j, std::int64_t k) {
        if (nodes_.id(i) < nodes_.id(j) && nodes_.id(i) < nodes_.id(k))
          fill_triangle({x, nodes_.position(j), nodes_.position(k)}, d, pieces, nodes);
      });
    }
  });
  return nodes;
}

// Are these the ends of a boundary edge?
bool Level::on_one_edge(std::int64_t i, std::int64_t j) const {
  return !nodes_.moves(i) && !nodes_.moves(j) &&
         fans_.joined(nodes_.boundary_node(i), nodes_.boundary_node(j));
}

SpacingVariation Level::spacing_variation() const {
  constexpr double kBetweenSamples = 0.7;  // the farthest of a leaf, in units of its side
  SpacingVariation own;
  for (std::int32_t leaf = 0; leaf < map_.tree().leaf_count(); ++leaf) {
    if (!distribution_.owns(leaf) || map_.leaf_outside(leaf)) continue;
    const double least = map_.leaf_least_spacing(leaf), largest = map_.leaf_largest_spacing(leaf);
    // Next to the boundary the samples may be those of the cell above.
    const double cell = map_.tree().cell_side(map_.tree().leaf_cell(leaf)),
                 way = kBetweenSamples * (map_.leaf_has_edges(leaf) ? 2 * cell : cell);
    own.least = std::min(own.least, least);
    own.largest = std::max(own.largest, largest);
    own.steepest = std::max(own.steepest, (largest - least) / way);
  }
  return {-comm_->largest(-own.least), comm_->largest(own.largest), comm_->largest(own.steepest)};
}

TakenNodes Level::take(std::vector<GivenNode> given, std::int64_t next_id) {
  const PhaseTimer timer(timers_, Phase::fill);
  next_id_ = next_id;
  scatter_to_owners(given);
  keep_boundary_ids(given);
  std::erase_if(given, [](const GivenNode& node) { return !node.inner; });
  find_leaves(given);
  const std::size_t all = given.size();
  keep_those_with_place(given);
  const std::size_t fitting = given.size();
  sort_by_place(given);
  thin(given);
  const std::size_t taken = given.size();
  const auto numbered = static_cast<std::uint64_t>(
      std::count_if(given.begin(), given.end(), [](const GivenNode& node) { return node.id < 0; }));
  number_and_store(std::move(given));
  return {static_cast<std::int64_t>(comm_->sum(all - fitting)),
          static_cast<std::int64_t>(comm_->sum(fitting - taken)),
          static_cast<std::int64_t>(comm_->sum(numbered))};
}

void Level::find_leaves(std::vector<GivenNode>& given) const {
  for_each("pnpbs::Level::find_leaves", static_cast<std::int64_t>(given.size()),
           [&](std::int64_t k) {
             GivenNode& node = given[static_cast<std::size_t>(k)];
             node.leaf = map_.tree().leaf_at(node.position);
           });
}

void Level::keep_those_with_place(std::vector<GivenNode>& given) const {
  std::vector<char> stays(given.size());
  for_each("pnpbs::Level::has_place", static_cast<std::int64_t>(given.size()), [&](std::int64_t n) {
    const auto k = static_cast<std::size_t>(n);
    stays[k] = has_place(given[k]);
  });
  std::size_t kept = 0;
  for (std::size_t k = 0; k < given.size(); ++k)
    if (stays[k] != 0) given[kept++] = given[k];
  given.resize(kept);
}

// In the domain, and not too close to its boundary.
bool Level::has_place(const GivenNode& node) const {
  if (near_edges_.leaf_is_clear(node.leaf)) return !map_.leaf_outside(node.leaf);
  return fits(node.position, map_.leaf_spacing(node.leaf));
}

// By leaf, in Morton order, and by place within it, so that nothing depends on where nodes came
// from.
void Level::sort_by_place(std::vector<GivenNode>& given) const {
  std::vector<std::size_t> begin(static_cast<std::size_t>(map_.tree().leaf_count()) + 1, 0);
  for (const GivenNode& node : given) ++begin[static_cast<std::size_t>(node.leaf) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<GivenNode> sorted(given.size());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (const GivenNode& node : given) sorted[next[static_cast<std::size_t>(node.leaf)]++] = node;
  given = std::move(sorted);
  for_each("pnpbs::Level::sort_by_place", map_.tree().leaf_count(), [&](std::int64_t leaf) {
    const auto first = given.begin() + static_cast<std::ptrdiff_t>(begin[leaf]);
    const auto last = given.begin() + static_cast<std::ptrdiff_t>(begin[leaf + 1]);
    std::sort(first, last, [](const GivenNode& a, const GivenNode& b) {
      return std::tie(a.position[1], a.position[0], a.id) <
             std::tie(b.position[1], b.position[0], b.id);
    });
  });
}

// Where nodes are many times too dense for d, because d has grown since they were placed or because
// they were given so, contests would take long to delete them. Each then counts for the share that
// should stay, and along the Morton order of the leaves a node stays whenever the sum of the shares
// passes a whole number. The nodes are sorted by place.
void Level::thin(std::vector<GivenNode>& inner) const {
  constexpr double kCrowded = 1.5;  // times the nodes that d asks for in a leaf, and a few
  constexpr std::int64_t kOne = std::int64_t{1} << 32;
  const auto leaf_of = [](const GivenNode& node) { return static_cast<std::size_t>(node.leaf); };
  const std::vector<double> wanted = wanted_nodes();
  std::vector<double> given_in(wanted.size(), 0);
  for (const GivenNode& node : inner) given_in[leaf_of(node)] += 1;
  const auto share_of = [&](const GivenNode& node) {
    const std::size_t leaf = leaf_of(node);
    const double d = map_.leaf_spacing(node.leaf);
    double share = 1;
    if (node.d > 0 && d > 1.02 * node.d) share = (node.d / d) * (node.d / d);
    if (given_in[leaf] > kCrowded * wanted[leaf] + 4)
      share = std::min(share, wanted[leaf] / given_in[leaf]);
    return static_cast<std::int64_t>(share * static_cast<double>(kOne));
  };
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
// ids is nearly the order in memory. The nodes are sorted by place.
void Level::number_and_store(std::vector<GivenNode> inner) {
  ++version_;
  // Nodes in one place would never part: the first of them counts.
  inner.erase(
      std::unique(inner.begin(), inner.end(),
                  [](const GivenNode& a, const GivenNode& b) { return a.position == b.position; }),
      inner.end());
  double most_id = static_cast<double>(next_id_ - 1);
  for (const GivenNode& node : inner) most_id = std::max(most_id, static_cast<double>(node.id));
  next_id_ = static_cast<std::int64_t>(comm_->largest(most_id)) + 1;

  std::vector<std::pair<std::int32_t, std::int32_t>> own_boundary;  // leaf and node
  for (std::size_t b = 0; b < boundary_.nodes.size(); ++b) {
    const std::int32_t leaf = map_.tree().leaf_at(boundary_.nodes[b].position);
    if (distribution_.owns(leaf)) own_boundary.emplace_back(leaf, static_cast<std::int32_t>(b));
  }
  std::sort(own_boundary.begin(), own_boundary.end());

  std::vector<std::int64_t> new_ids(static_cast<std::size_t>(map_.tree().leaf_count()), 0);
  for (const auto& [leaf, b] : own_boundary)
    new_ids[static_cast<std::size_t>(leaf)] += boundary_ids_[static_cast<std::size_t>(b)] < 0;
  for (const GivenNode& node : inner) new_ids[static_cast<std::size_t>(node.leaf)] += node.id < 0;
  std::vector<std::int64_t> next = distribution_.prefix_sums(*comm_, std::move(new_ids), next_id_);
  const auto number = [&](std::int64_t id, std::int32_t leaf) {
    return id >= 0 ? id : next[static_cast<std::size_t>(leaf)]++;
  };

  nodes_.count = 0;
  in_buckets_ = false;
  const std::size_t count = own_boundary.size() + inner.size();
  nodes_.reserve(static_cast<std::int64_t>(count + count / 64) + 64);
  auto of_boundary = own_boundary.begin();
  const auto store_boundary_until = [&](std::int32_t last_leaf) {
    for (; of_boundary != own_boundary.end() && of_boundary->first <= last_leaf; ++of_boundary) {
      const auto& [leaf, b] = *of_boundary;
      const BoundaryNode& node = boundary_.nodes[static_cast<std::size_t>(b)];
      nodes_.append(node.position, 1, number(boundary_ids_[static_cast<std::size_t>(b)], leaf),
                    node.tag, b);
    }
  };
  for (const GivenNode& node : inner) {
    store_boundary_until(node.leaf);
    nodes_.append(node.position, 1, number(node.id, node.leaf), 0, -1);
  }
  store_boundary_until(map_.tree().leaf_count());
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
