// SPDX-License-Identifier: BSD-3-Clause
// Tests the partition of a volume: cells of an octree refined about a point, the graph for METIS,
// owners, and halos against brute force.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "base/mixed_hash.hpp"
#include "octree_on_ranks.hpp"
#include "partition/partition.hpp"
#include "rank_checks.hpp"

namespace {

using octree::BackgroundTree;
using octree::Point;
using pnpbs::PartitionCell;
using pnpbs::PartitionCells;
using rank_checks::comm;
using rank_checks::expect;

constexpr std::int64_t kCellsPerRank = 250;  // as in partition/partition_cells.cpp

std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

double spacing(const Point<3>& x) { return 0.006 + 0.06 * pnpbs::distance<3>(x, {0.3, 0.4, 0.6}); }

double leaf_width(const Point<3>& x) { return 4 * spacing(x); }

template <class T>
std::uint64_t hash_of(const std::vector<T>& values) {
  std::uint64_t hash = 0;
  for (const T& value : values) hash = pnpbs::mixed(hash ^ static_cast<std::uint64_t>(value));
  return hash;
}

// ------------------------------------------------------------------ the cells ------------------

std::uint64_t hash_of_cells(const std::vector<PartitionCell<3>>& cells) {
  std::uint64_t hash = 0;
  for (const PartitionCell<3>& cell : cells) {
    for (const std::uint32_t i : cell.index) hash = pnpbs::mixed(hash ^ i);
    hash = pnpbs::mixed(hash ^ static_cast<std::uint64_t>(cell.depth));
    hash = pnpbs::mixed(hash ^ static_cast<std::uint64_t>(cell.work));
    hash = pnpbs::mixed_with(hash, cell.max_spacing);
  }
  return hash;
}

// Expects that the cells are the leaves of a tree and therefore tile its root.
void check_tiling(const std::vector<PartitionCell<3>>& list, const PartitionCells<3>& cells) {
  expect(index(cells.count()) == list.size(), "as many cells as leaves of their tree");
  std::vector<int> met(index(cells.count()), 0);
  for (const PartitionCell<3>& cell : list) {
    const double side = std::ldexp(cells.tree().side(), -cell.depth);
    Point<3> centre;
    for (int k = 0; k < 3; ++k)
      centre[index(k)] = cells.tree().origin()[index(k)] + side * (cell.index[index(k)] + 0.5);
    const std::int32_t c = cells.at(centre);
    const BackgroundTree<3>::Cell& leaf = cells.tree().cell(cells.tree().leaf_cell(c));
    expect(leaf.depth == cell.depth && leaf.index == cell.index, "a cell is a leaf of the tree");
    ++met[index(c)];
  }
  expect(std::all_of(met.begin(), met.end(), [](int n) { return n == 1; }), "each cell once");
}

// Checks the work of the cells. Returns the largest work that a cell may have: the equal share of a
// cell, or the work of a leaf.
std::int64_t check_work(const BackgroundTree<3>& tree, const std::vector<double>& d,
                        const PartitionCells<3>& cells) {
  const std::vector<std::int64_t> work = octree::leaf_work(tree, d);
  std::vector<std::int64_t> sum(index(cells.count()), 0);
  std::vector<double> max(index(cells.count()), 0);
  std::vector<int> leaves(index(cells.count()), 0);
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    const std::size_t c = index(cells.at(tree.cell_centre(tree.leaf_cell(leaf))));
    sum[c] += work[index(leaf)];
    max[c] = std::max(max[c], d[index(leaf)]);
    ++leaves[c];
  }
  const std::int64_t total = std::accumulate(work.begin(), work.end(), std::int64_t{0}),
                     share = total / (kCellsPerRank * comm->size());
  std::int64_t joined = 0;
  for (std::int32_t c = 0; c < cells.count(); ++c) {
    expect(cells.work(c) == sum[index(c)], "a cell's work is that of its leaves");
    expect(cells.max_spacing(c) == max[index(c)], "a cell's largest d");
    expect(leaves[index(c)] == 1 || cells.work(c) <= share, "a cell has no more than its share");
    joined += leaves[index(c)] > 1;
  }
  expect(comm->size() > 2 || joined > 0, "some cells hold several leaves");
  return std::max(share, *std::max_element(work.begin(), work.end()));
}

// ------------------------------------------------------------------ the graph ------------------

// A box in units of a cell of depth kFine, which is exact.
struct IntegerBox {
  static constexpr int kFine = 12;
  std::array<std::int64_t, 3> low, high;

  explicit IntegerBox(const BackgroundTree<3>::Cell& cell) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::int64_t{cell.index[k]} << (kFine - cell.depth);
      high[k] = (std::int64_t{cell.index[k]} + 1) << (kFine - cell.depth);
    }
  }
};

// Returns the area of the common face, 0 for cells without one.
std::int64_t common_area(const IntegerBox& a, const IntegerBox& b) {
  std::int64_t area = 1;
  int touching = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int64_t common = std::min(a.high[k], b.high[k]) - std::max(a.low[k], b.low[k]);
    if (common < 0) return 0;
    if (common == 0)
      ++touching;
    else
      area *= common;
  }
  return touching == 1 ? area : 0;
}

void check_graph(const PartitionCells<3>& cells, const pnpbs::CellGraph& graph) {
  const BackgroundTree<3>& tree = cells.tree();
  const double unit = std::ldexp(tree.side(), -IntegerBox::kFine);
  std::vector<IntegerBox> box;
  std::vector<double> per_length;  // of the work
  for (std::int32_t c = 0; c < cells.count(); ++c) {
    box.emplace_back(tree.cell(tree.leaf_cell(c)));
    per_length.push_back(std::cbrt(static_cast<double>(cells.work(c))) /
                         tree.cell_side(tree.leaf_cell(c)));
  }
  expect(graph.cell.size() == box.size(), "every cell has work, so each is a vertex");
  // Each rank compares some of the cells with all others.
  for (std::size_t a = index(comm->rank()); a < box.size(); a += index(comm->size())) {
    std::size_t link = index(graph.offset[a]);
    for (std::size_t b = 0; b < box.size(); ++b) {
      const std::int64_t area = a == b ? 0 : common_area(box[a], box[b]);
      const bool linked = link < index(graph.offset[a + 1]) && index(graph.neighbour[link]) == b;
      expect(linked == (area > 0), "cells are linked where they have a face in common");
      if (!linked) continue;
      const double length = unit * std::max(per_length[a], per_length[b]);
      const double pairs = static_cast<double>(area) * length * length;
      expect(std::fabs(graph.cut_weight[link] - (1 + std::floor(pairs))) <= 1, "weight of a link");
      ++link;
    }
    expect(link == index(graph.offset[a + 1]), "no other links");
  }
}

std::int64_t cut_of(const pnpbs::CellGraph& graph, const std::vector<std::int32_t>& owner) {
  std::int64_t cut = 0;
  for (std::size_t a = 0; a < graph.cell.size(); ++a)
    for (std::int32_t k = graph.offset[a]; k < graph.offset[a + 1]; ++k)
      if (owner[a] != owner[index(graph.neighbour[index(k)])]) cut += graph.cut_weight[index(k)];
  return cut / 2;
}

// The Morton order assigns a cell to the part in which the middle of its work lies. A part exceeds
// its equal share by at most half a cell at either end, so its imbalance is at most 1 + ranks *
// largest / total. The result of METIS is used if its imbalance is at most 1.1 times this.
void check_cut(const PartitionCells<3>& cells, const pnpbs::CellGraph& graph, std::int64_t max) {
  const int ranks = comm->size();
  const std::vector<std::int32_t> owner = pnpbs::cut_by_metis(cells, ranks, 1),
                                  plain = pnpbs::cut_morton_order(cells.work(), ranks);
  const std::int64_t total =
      std::accumulate(cells.work().begin(), cells.work().end(), std::int64_t{0});
  const double bound = 1 + static_cast<double>(ranks * max) / static_cast<double>(total);
  const double imbalance = pnpbs::imbalance(owner, cells.work(), ranks);
  expect(pnpbs::imbalance(plain, cells.work(), ranks) <= bound, "balance of the Morton order");
  expect(imbalance <= 1.1 * bound, "balance of what METIS cuts");
  expect(comm->same_on_all(hash_of(owner)), "the same owners on all ranks");
  const std::int64_t cut = cut_of(graph, owner), plain_cut = cut_of(graph, plain);
  expect(ranks == 1 ? cut == 0 : cut < plain_cut, "METIS cuts less than the Morton order");
  if (comm->rank() == 0)
    std::printf("%d cells, imbalance %.3f (at most %.3f), cut %lld (Morton order: %lld)\n",
                cells.count(), imbalance, 1.1 * bound, static_cast<long long>(cut),
                static_cast<long long>(plain_cut));
}

// Cells in one octant have rare work as well, which no part may have much more of than its share.
void check_cut_with_rare_work(std::vector<PartitionCell<3>> list) {
  const int ranks = comm->size();
  for (PartitionCell<3>& cell : list) {
    const std::uint32_t half = 1U << (cell.depth > 0 ? cell.depth - 1 : 0);
    if (cell.depth > 0 && cell.index[0] < half && cell.index[1] < half && cell.index[2] < half)
      cell.rare_work = cell.work / 10;
  }
  const PartitionCells<3> cells(pnpbs::Box<3>{{0, 0, 0}, {1, 1, 1}}, list);
  const std::vector<std::int32_t> owner = pnpbs::cut_by_metis(cells, ranks, 1);
  const double often = pnpbs::imbalance(owner, cells.work(), ranks),
               rare = pnpbs::imbalance(owner, cells.rare_work(), ranks);
  if (comm->rank() == 0) std::printf("imbalance %.3f, of rare work %.3f\n", often, rare);
  expect(often <= 1.1 && rare <= 1.2, "balance of both kinds of work");
}

void check_partition() {
  const BackgroundTree<3> tree = octree::refined_to(leaf_width);
  const std::vector<double> d = octree::max_spacings(tree, spacing);
  const std::vector<PartitionCell<3>> list = octree::equal_cells(*comm, tree, d);
  expect(comm->same_on_all(hash_of_cells(list)), "the same cells on all ranks");
  const PartitionCells<3> cells(pnpbs::Box<3>{{0, 0, 0}, {1, 1, 1}}, list);
  check_tiling(list, cells);
  const std::int64_t max = check_work(tree, d, cells);
  const pnpbs::CellGraph graph = pnpbs::cell_graph(cells);
  check_graph(cells, graph);
  check_cut(cells, graph, max);
  check_cut_with_rare_work(list);
}

}  // namespace

int main(int argc, char** argv) { return rank_checks::run_in_groups(argc, argv, check_partition); }
