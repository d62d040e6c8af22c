// SPDX-License-Identifier: BSD-3-Clause
// The partition of a level: the background tree, refined on each rank where its own nodes and
// ghosts can be, and its cells dealt out by the work in them.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include "base/error.hpp"
#include "base/mixed_hash.hpp"
#include "comm/records.hpp"
#include "initial/initial_fill.hpp"
#include "level/level.hpp"
#include "partition/partition.hpp"

namespace pnpbs {

namespace {

// What a node costs besides its listed pairs, in units of one pair.
constexpr std::int64_t kNodeWork = 8;

Bytes bytes_of(const std::vector<std::int32_t>& values) {
  Bytes bytes(values.size() * sizeof(std::int32_t));
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

std::vector<std::int32_t> integers_of(const Bytes& bytes) {
  std::vector<std::int32_t> values(bytes.size() / sizeof(std::int32_t));
  if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

}  // namespace

void Level::grow_tree(const Level* like) {
  if (!distributed()) {
    const PhaseTimer timer(timers_, Phase::tree);
    map_.build(domain_->bounds(), boundary_, evaluator(), settings_.node_limit());
    link_leaves();
    look_at_new_tree();
    return;
  }
  const PhaseTimer timer(timers_, Phase::partition);
  // First roughly; then what lies in each part is known, and is cut again.
  if (like)
    distribution_ = like->distribution_.without_leaves();
  else
    take_rough_cells();
  require_same_ground(distribution_.cells());
  std::vector<char> own;
  for (std::int32_t c = 0; c < distribution_.cells().count(); ++c)
    own.push_back(distribution_.owner_of_cell(c) == comm_->rank());
  refine_tree(own);
  PartitionCells<2> cells(
      domain_->bounds(), cells_of_equal_work(*comm_, map_.tree(), leaf_functions(expected_work())));
  std::vector<std::int32_t> owner =
      like ? cut_like(like->distribution_, cells) : cut_on_first_rank(cells);
  distribution_ = Distribution<2>(std::move(cells), std::move(owner), comm_->rank());
  grow_own_part();
}

// By a few samples of d.
void Level::take_rough_cells() {
  PartitionCells<2> cells(domain_->bounds(), rough_cells());
  std::vector<std::int32_t> owner = cut_morton_order(cells.work(), comm_->size());
  distribution_ = Distribution<2>(std::move(cells), std::move(owner), comm_->rank());
}

// What one level hands on to the next then stays where it is.
std::vector<std::int32_t> Level::cut_like(const Distribution<2>& other,
                                          const PartitionCells<2>& cells) const {
  constexpr double kBalanced = 1.05;  // a coarse level has few nodes, and little of the work
  std::vector<std::int32_t> owner;
  for (std::int32_t c = 0; c < cells.count(); ++c)
    owner.push_back(other.owner_at(cells.tree().cell_centre(cells.tree().leaf_cell(c))));
  if (pnpbs::imbalance(owner, cells.work(), comm_->size()) <= kBalanced) return owner;
  return cut_on_first_rank(cells);
}

namespace {

constexpr const char* kSpacingsDiffer =
    "the spacing (or a curve given by a callback) differs between ranks: every rank gives the same "
    "function of the point";

}  // namespace

// Ranks whose callbacks tell different things would wait for each other for ever.
void Level::require_same_ground(const PartitionCells<2>& cells) const {
  std::uint64_t fingerprint = 0;
  for (const BoundaryNode& node : boundary_.nodes)
    for (double coordinate : node.position) fingerprint = mixed_with(fingerprint, coordinate);
  for (std::int32_t c = 0; c < cells.count(); ++c)
    fingerprint = mixed_with(fingerprint, cells.largest_spacing(c));
  if (!comm_->same_on_all(fingerprint)) throw Error(ErrorKind::spacing, kSpacingsDiffer);
}

// The same, once the leaves are there: what each rank finds in cells of others must be what their
// owners find.
void Level::require_same_leaves() const {
  std::vector<std::uint64_t> found(static_cast<std::size_t>(distribution_.cells().count()), 0);
  for (std::int32_t leaf = 0; leaf < map_.tree().leaf_count(); ++leaf) {
    std::uint64_t& cell = found[static_cast<std::size_t>(distribution_.cell_of(leaf))];
    cell = mixed_with(cell, map_.leaf_spacing(leaf));
  }
  struct Finding {
    std::int32_t cell;
    std::uint64_t fingerprint;
  };
  Bytes own;
  for (std::int32_t c = 0; c < distribution_.cells().count(); ++c)
    if (distribution_.owner_of_cell(c) == comm_->rank())
      pack(own, Finding{c, found[static_cast<std::size_t>(c)]});
  bool same = true;
  for_records<Finding>({comm_->allgather(own)}, [&](const Finding& finding) {
    if (distribution_.cell_refined(finding.cell))
      same = same && finding.fingerprint == found[static_cast<std::size_t>(finding.cell)];
  });
  if (comm_->allreduce_max(!same) > 0) throw Error(ErrorKind::spacing, kSpacingsDiffer);
}

// What goes by the leaves of the tree.
void Level::look_at_new_tree() {
  near_edges_.prepare(map_, *links_, edge_radius());
  forget_what_goes_by_leaves();
}

void Level::forget_what_goes_by_leaves() {
  buckets_.reset(links_);
  plan_ = HaloExchange<2>();
  ghost_hops_ = 0;
  lists_valid_ = false;
}

std::function<bool(std::int32_t)> Level::owns_leaf() const {
  return [this](std::int32_t leaf) { return distribution_.owns(leaf); };
}

LeafFunctions Level::leaf_functions(std::vector<std::int64_t> work) const {
  return {
      owns_leaf(),
      [work = std::move(work)](std::int32_t leaf) { return work[static_cast<std::size_t>(leaf)]; },
      [this](std::int32_t leaf) {
        return map_.leaf_outside(leaf) ? 0 : map_.leaf_largest_spacing(leaf);
      }};
}

// From samples of d in large cells, the same on every rank: enough to begin with.
std::vector<PartitionCell<2>> Level::rough_cells() {
  constexpr int kUniformDepth = 3, kPasses = 3, kCellsPerRank = 32;
  double most = std::numeric_limits<double>::infinity();
  std::vector<std::int64_t> work;
  for (int pass = 0; pass < kPasses; ++pass) {
    map_.build_part(*comm_, domain_->bounds(), boundary_, evaluator(), settings_.node_limit(),
                    [&](const BackgroundTree<2>& tree, std::int32_t c, double nodes) {
                      return tree.cell(c).depth < kUniformDepth || nodes > most;
                    });
    work = expected_work();
    most = static_cast<double>(std::accumulate(work.begin(), work.end(), std::int64_t{0})) /
           (kWorkPerNode * kCellsPerRank * comm_->size());
  }
  std::vector<PartitionCell<2>> cells;
  for (std::int32_t leaf = 0; leaf < map_.tree().leaf_count(); ++leaf) {
    const BackgroundTree<2>::Cell& cell = map_.tree().cell(map_.tree().leaf_cell(leaf));
    cells.push_back({cell.index, cell.depth, work[static_cast<std::size_t>(leaf)],
                     map_.leaf_largest_spacing(leaf)});
  }
  return cells;
}

// Of each leaf, by the nodes that d asks for; half of a leaf that the boundary crosses.
std::vector<std::int64_t> Level::expected_work() const {
  std::vector<std::int64_t> work;
  for (std::int32_t leaf = 0; leaf < map_.tree().leaf_count(); ++leaf) {
    const double side = map_.tree().cell_side(map_.tree().leaf_cell(leaf)),
                 d = map_.leaf_spacing(leaf);
    const double nodes = map_.leaf_outside(leaf) || d == 0 ? 0
                         : map_.leaf_has_edges(leaf)       ? 0.5 * side * side / (d * d)
                                                           : side * side / (d * d);
    work.push_back(map_.leaf_outside(leaf)
                       ? 0
                       : 1 + static_cast<std::int64_t>(std::round(kWorkPerNode * nodes)));
  }
  return work;
}

// The tree in full in the cells marked.
void Level::refine_tree(const std::vector<char>& refined) {
  const BackgroundTree<2>& cells = distribution_.cells().tree();
  map_.build_part(*comm_, domain_->bounds(), boundary_, evaluator(), settings_.node_limit(),
                  [&](const BackgroundTree<2>& tree, std::int32_t c, double) {
                    const BackgroundTree<2>::Cell& in =
                        cells.cell(cells.cell_at(tree.cell_centre(c), tree.cell(c).depth));
                    return in.first_child >= 0 || refined[static_cast<std::size_t>(in.leaf)];
                  });
  distribution_.take_leaves(&map_.tree(), refined);
}

void Level::link_leaves() {
  std::vector<double> reach;
  for (std::int32_t leaf = 0; leaf < map_.tree().leaf_count(); ++leaf) {
    const double d = !distributed() || distribution_.refined(leaf)
                         ? map_.leaf_largest_spacing(leaf)
                         : distribution_.cells().largest_spacing(distribution_.cell_of(leaf));
    reach.push_back(map_.leaf_outside(leaf) ? 0 : kRoomForGrowth * widest_radius() * d);
  }
  links_ = std::make_shared<const LeafLinks<2>>(map_.tree(), std::move(reach));
}

// In full wherever own nodes and ghosts can be. What is within the hops is known only once it is
// there: more is refined until nothing is missing.
void Level::grow_own_part() {
  const int hops = deepest_hops();
  std::vector<char> refined = distribution_.cells_near_own(hops, kRoomForGrowth * widest_radius());
  for (bool missing = true; missing;) {
    refine_tree(refined);
    link_leaves();
    distribution_.link_leaves(links_);
    const std::vector<std::int32_t> more = distribution_.unrefined_within(hops);
    for (std::int32_t cell : more) refined[static_cast<std::size_t>(cell)] = 1;
    missing = comm_->allreduce_max(!more.empty()) > 0;
  }
  require_same_leaves();
  tree_hops_ = hops;
  look_at_new_tree();
}

std::vector<std::int32_t> Level::cut_on_first_rank(const PartitionCells<2>& cells) const {
  Bytes bytes;
  agreed(*comm_, [&] {
    if (comm_->rank() == 0)
      bytes = bytes_of(cut_by_metis(cells, comm_->size(), settings_.metis_seed));
  });
  comm_->broadcast(bytes, 0);
  return integers_of(bytes);
}

std::int64_t Level::node_work(std::int64_t i) const {
  std::int64_t pairs = 0;
  lists_.for_neighbours(i, [&](std::int64_t) { ++pairs; });
  return kNodeWork + pairs;
}

void Level::count_work() {
  const auto none = static_cast<std::int32_t>(nodes_.count);  // what short lists are filled with
  owned_work_ = static_cast<std::int64_t>(
      sum_of("pnpbs::Level::count_work", lists_.block_count(), [&](std::int64_t b) {
        const ListBlock list = lists_.block(b);
        std::int64_t pairs[kLanes]{};
        for (std::int32_t k = 0; k < list.length; ++k)
          for (int lane = 0; lane < kLanes; ++lane)
            pairs[lane] += list.entries[k * kLanes + lane] != none;
        std::int64_t work = 0;
        for (std::int64_t i = b * kLanes; i < std::min((b + 1) * kLanes, nodes_.count); ++i)
          if (nodes_.owned(i)) work += kNodeWork + pairs[i % kLanes];
        return work;
      }));
  work_is_old_ = false;
}

double Level::imbalance() const {
  const auto all =
      static_cast<double>(comm_->allreduce_sum(static_cast<std::uint64_t>(owned_work_)));
  return all > 0 ? comm_->allreduce_max(static_cast<double>(owned_work_)) * comm_->size() / all : 1;
}

std::vector<std::int64_t> Level::counted_work() const {
  const BackgroundTree<2>& tree = map_.tree();
  std::vector<std::int64_t> work(static_cast<std::size_t>(tree.leaf_count()), 0);
  for (std::int64_t i = 0; i < nodes_.count; ++i)
    if (nodes_.owned(i))
      work[static_cast<std::size_t>(tree.leaf_at(nodes_.position(i)))] += node_work(i);
  return work;
}

void Level::rebalance() {
  if (!distributed()) return;
  exchange(step_hops());
  agreed(*comm_, [this] { rebuild_lists(); });
  const PhaseTimer timer(timers_, Phase::partition);
  const std::vector<std::int64_t> work = counted_work();
  PartitionCells<2> cells(domain_->bounds(),
                          cells_of_equal_work(*comm_, map_.tree(), leaf_functions(work)));
  std::vector<std::int32_t> owner = keep_numbers(cells, cut_on_first_rank(cells), work);
  adopt(Distribution<2>(std::move(cells), std::move(owner), comm_->rank()));
  migrate();
  exchange(step_hops());
  work_is_old_ = true;
  agreed(*comm_, [this] { rebuild_lists(); });
  ++rebalances_;
}

// Parts get the numbers that let most of the work stay where it is.
std::vector<std::int32_t> Level::keep_numbers(const PartitionCells<2>& cells,
                                              std::vector<std::int32_t> part,
                                              const std::vector<std::int64_t>& work) const {
  const auto ranks = static_cast<std::size_t>(comm_->size()),
             rank = static_cast<std::size_t>(comm_->rank());
  const BackgroundTree<2>& tree = map_.tree();
  std::vector<std::int64_t> kept(ranks * ranks, 0);
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    if (!distribution_.owns(leaf)) continue;
    const std::int32_t cell = cells.at(tree.cell_centre(tree.leaf_cell(leaf)));
    const auto to = static_cast<std::size_t>(part[static_cast<std::size_t>(cell)]);
    kept[to * ranks + rank] += work[static_cast<std::size_t>(leaf)];
  }
  comm_->allreduce_sum(kept);
  return relabelled(std::move(part), kept, comm_->size());
}

// The nodes are yet to migrate. If it fails, all stays as it was; putting it back asks for no
// memory, there may be none.
void Level::adopt(Distribution<2> next) {
  DomainMap map_before = std::move(map_);
  NearEdges near_edges_before =
      std::exchange(near_edges_, {});  // a View moved from is no empty one
  Distribution<2> before = std::exchange(distribution_, std::move(next));
  std::shared_ptr<const LeafLinks<2>> links_before = links_;
  try {
    grow_own_part();
  } catch (...) {
    map_ = std::move(map_before);
    near_edges_ = std::move(near_edges_before);
    distribution_ = std::move(before);
    links_ = std::move(links_before);
    forget_what_goes_by_leaves();
    throw;
  }
}

}  // namespace pnpbs
