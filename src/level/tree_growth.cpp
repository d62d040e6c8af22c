// SPDX-License-Identifier: BSD-3-Clause
// The growth of a level's tree. One rank refines it everywhere; several ranks refine it only where
// their own nodes and ghosts can be.
#include <limits>
#include <numeric>

#include "base/error.hpp"
#include "base/mixed_hash.hpp"
#include "comm/records.hpp"
#include "domain/domain.hpp"
#include "level/level_tree.hpp"
#include "level/partitioning.hpp"
#include "level/reach.hpp"
#include "partition/partition.hpp"

namespace pnpbs {

template <int Dim>
std::unique_ptr<LevelTree<Dim>> LevelTree<Dim>::grow(const Communicator& comm,
                                                     const LevelGeometry<Dim>& geometry,
                                                     const Settings& settings,
                                                     const LevelTree<Dim>* like) {
  std::unique_ptr<LevelTree<Dim>> tree(new LevelTree(comm, geometry));
  if (!tree->distributed())
    tree->grow_whole(settings);
  else
    tree->grow_part(settings, like);
  return tree;
}

template <int Dim>
std::unique_ptr<LevelTree<Dim>> LevelTree<Dim>::grow(const Communicator& comm,
                                                     const LevelGeometry<Dim>& geometry,
                                                     const Settings& settings,
                                                     Distribution<Dim> distribution) {
  std::unique_ptr<LevelTree<Dim>> tree(new LevelTree(comm, geometry));
  tree->distribution_ = std::move(distribution);
  tree->grow_own_part(settings);
  return tree;
}

template <int Dim>
void LevelTree<Dim>::grow_whole(const Settings& settings) {
  map_.build(geometry_.tree_bounds(), geometry_.boundary(), geometry_.evaluator(),
             settings.node_limit(), kLevelRefinement<Dim>, spacing_hints());
  link_leaves(settings);
}

// Returns points where samples may miss small values of d: where d is reduced, and undersampled
// points that nodes have met. A cone of d as narrow as a leaf is seen by at most one of its
// samples.
template <int Dim>
std::vector<GrowthSource<Dim>> LevelTree<Dim>::spacing_hints() const {
  return geometry_.spacing().spacing_hints().in_domain;
}

// Partitions roughly first. The work in each part is then known, and the tree is partitioned again.
template <int Dim>
void LevelTree<Dim>::grow_part(const Settings& settings, const LevelTree<Dim>* like) {
  if (like)
    distribution_ = like->distribution_.without_leaves();
  else
    take_rough_cells(settings);
  require_same_geometry();
  std::vector<char> own;
  for (std::int32_t c = 0; c < distribution_.cells().count(); ++c)
    own.push_back(distribution_.owner_of_cell(c) == comm_.rank());
  refine(settings, own);
  PartitionCells<Dim> cells = cells_of_equal_work(*this, expected_work(map_));
  std::vector<std::int32_t> owner = like ? cut_like(comm_, settings, like->distribution_, cells)
                                         : cut_on_first_rank(comm_, settings, cells);
  distribution_ = Distribution<Dim>(std::move(cells), std::move(owner), comm_.rank(), comm_.size());
  grow_own_part(settings);
}

// Partitions by a few samples of d, along the Morton order.
template <int Dim>
void LevelTree<Dim>::take_rough_cells(const Settings& settings) {
  PartitionCells<Dim> cells(geometry_.tree_bounds(), rough_cells(settings));
  std::vector<std::int32_t> owner = cut_morton_order(cells.work(), comm_.size());
  distribution_ = Distribution<Dim>(std::move(cells), std::move(owner), comm_.rank(), comm_.size());
}

// Returns large cells with the work that samples of d imply. They are the same on every rank.
template <int Dim>
std::vector<PartitionCell<Dim>> LevelTree<Dim>::rough_cells(const Settings& settings) {
  constexpr int kUniformDepth = 3, kPasses = 3, kCellsPerRank = 32;
  double max = std::numeric_limits<double>::infinity();
  std::vector<std::int64_t> work;
  for (int pass = 0; pass < kPasses; ++pass) {
    map_.build_part(
        comm_, geometry_.tree_bounds(), geometry_.boundary(), geometry_.evaluator(),
        settings.node_limit(),
        [&](const BackgroundTree<Dim>& tree, std::int32_t c, double nodes) {
          return tree.cell(c).depth < kUniformDepth || nodes > max ||
                 geometry_.domain().embedding().varies_much_in(tree.cell_box(c));
        },
        kLevelRefinement<Dim>);
    work = expected_work(map_);
    for (std::int32_t leaf = 0; leaf < map_.tree().leaf_count(); ++leaf)
      if (!map_.tree().in_periodic_cell(leaf)) work[static_cast<std::size_t>(leaf)] = 0;
    max = static_cast<double>(std::accumulate(work.begin(), work.end(), std::int64_t{0})) /
          (kWorkPerNode * kCellsPerRank * comm_.size());
  }
  std::vector<PartitionCell<Dim>> cells;
  for (std::int32_t leaf = 0; leaf < map_.tree().leaf_count(); ++leaf) {
    if (!map_.tree().in_periodic_cell(leaf)) continue;
    const typename BackgroundTree<Dim>::Cell& cell = map_.tree().cell(map_.tree().leaf_cell(leaf));
    cells.push_back({cell.index, cell.depth, work[static_cast<std::size_t>(leaf)],
                     map_.leaf_max_spacing(leaf)});
  }
  return cells;
}

// Refines the tree to its leaves in the marked cells.
template <int Dim>
void LevelTree<Dim>::refine(const Settings& settings, const std::vector<char>& refined) {
  const BackgroundTree<Dim>& cells = distribution_.cells().tree();
  map_.build_part(
      comm_, geometry_.tree_bounds(), geometry_.boundary(), geometry_.evaluator(),
      settings.node_limit(),
      [&](const BackgroundTree<Dim>& tree, std::int32_t c, double) {
        const typename BackgroundTree<Dim>::Cell& in =
            cells.cell(cells.cell_at(tree.cell_centre(c), tree.cell(c).depth));
        return in.first_child >= 0 || refined[static_cast<std::size_t>(in.leaf)];
      },
      kLevelRefinement<Dim>, spacing_hints());
  distribution_.take_leaves(&map_.tree(), refined);
}

template <int Dim>
void LevelTree<Dim>::link_leaves(const Settings& settings) {
  std::vector<double> reach;
  for (std::int32_t leaf = 0; leaf < map_.tree().leaf_count(); ++leaf) {
    const double d = !distributed() || distribution_.refined(leaf)
                         ? map_.leaf_max_spacing(leaf)
                         : distribution_.cells().max_spacing(distribution_.cell_of(leaf));
    reach.push_back(map_.leaf_empty(leaf) ? 0 : kRoomForGrowth * widest_radius(settings) * d);
  }
  std::vector<double> stretch;
  const Embedding<Dim>& embedding = geometry_.domain().embedding();
  if (embedding.is_sphere())
    for (std::int32_t leaf = 0; leaf < map_.tree().leaf_count(); ++leaf)
      stretch.push_back(
          embedding.max_stretch_in(map_.tree().cell_box(map_.tree().leaf_cell(leaf))));
  links_ =
      std::make_shared<const LeafGraph<Dim>>(map_.tree(), std::move(reach), std::move(stretch));
}

// Refines the tree wherever own nodes and ghosts can be. Only the refined tree shows what lies
// within the hops, so cells are added until none is missing.
template <int Dim>
void LevelTree<Dim>::grow_own_part(const Settings& settings) {
  const int hops = deepest_hops(settings);
  std::vector<char> refined =
      distribution_.cells_near_own(hops, kRoomForGrowth * widest_radius(settings));
  for (bool missing = true; missing;) {
    refine(settings, refined);
    link_leaves(settings);
    distribution_.link_leaves(links_);
    const std::vector<std::int32_t> more = distribution_.unrefined_within(hops);
    for (std::int32_t cell : more) refined[static_cast<std::size_t>(cell)] = 1;
    missing = comm_.allreduce_max(!more.empty()) > 0;
  }
  require_same_leaves();
  hops_ = hops;
}

namespace {

constexpr const char* kSpacingsDiffer =
    "the spacing (or a curve given by a callback) differs between ranks: every rank gives the same "
    "function of the point";

}  // namespace

// Ranks whose callbacks return different values would wait for each other without end.
template <int Dim>
void LevelTree<Dim>::require_same_geometry() const {
  const PartitionCells<Dim>& cells = distribution_.cells();
  std::uint64_t fingerprint = 0;
  for (const BoundaryNode<Dim>& node : geometry_.boundary().nodes)
    for (double coordinate : node.position) fingerprint = mixed_with(fingerprint, coordinate);
  for (std::int32_t c = 0; c < cells.count(); ++c)
    fingerprint = mixed_with(fingerprint, cells.max_spacing(c));
  if (!comm_.same_on_all(fingerprint)) throw Error(ErrorKind::spacing, kSpacingsDiffer);
}

// Checks the leaves as well: what a rank finds in cells of others must equal what their owners
// find.
template <int Dim>
void LevelTree<Dim>::require_same_leaves() const {
  std::vector<std::uint64_t> found(static_cast<std::size_t>(distribution_.cells().count()), 0);
  for (std::int32_t leaf = 0; leaf < map_.tree().leaf_count(); ++leaf) {
    std::uint64_t& cell = found[static_cast<std::size_t>(distribution_.cell_of(leaf))];
    cell = mixed_with(cell, map_.leaf_spacing(leaf));
  }
  struct Finding {
    std::int64_t cell;
    std::uint64_t fingerprint;
  };
  std::vector<Finding> of_others;
  for (std::int32_t c = 0; c < distribution_.cells().count(); ++c)
    if (distribution_.cell_refined(c) && distribution_.owner_of_cell(c) != comm_.rank() &&
        distribution_.cells().origin_of(c) == c)
      of_others.push_back({c, found[static_cast<std::size_t>(c)]});
  const auto owner = [this](const Finding& finding) {
    return distribution_.owner_of_cell(static_cast<std::int32_t>(finding.cell));
  };
  bool same = true;
  for (const Finding& finding : redistribute(comm_, of_others, owner))
    same = same && finding.fingerprint == found[static_cast<std::size_t>(finding.cell)];
  if (comm_.allreduce_max(!same) > 0) throw Error(ErrorKind::spacing, kSpacingsDiffer);
}

template <int Dim>
const Halo& LevelTree<Dim>::halo(int hops, const Settings& settings) {
  return distribution_.halo(hops,
                            settings.list_radius / (kRoomForGrowth * widest_radius(settings)));
}

template class LevelTree<2>;
template class LevelTree<3>;

}  // namespace pnpbs
