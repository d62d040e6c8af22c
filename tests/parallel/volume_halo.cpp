// SPDX-License-Identifier: BSD-3-Clause
// Tests the owners, halos and prefix sums over leaves in Morton order of a volume against brute
// force, for domains that fill the box and others.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "base/mixed_hash.hpp"
#include "octree_on_ranks.hpp"
#include "rank_checks.hpp"
#include "tree/hop_search.hpp"

namespace {

using octree::BackgroundTree;
using octree::Point;
using pnpbs::Box;
using pnpbs::Distribution;
using rank_checks::comm;
using rank_checks::expect;

constexpr double kRadius = 1.7;  // of the lists
constexpr int kUnreached = 1000;

std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

double spacing(const Point<3>& x) { return 0.01 + 0.08 * pnpbs::distance<3>(x, {0.3, 0.4, 0.6}); }

double leaf_width(const Point<3>& x) { return 4 * spacing(x); }

// Returns whether the cell contains nothing of the domain.
bool empty_cell(const Distribution<3>& distribution, std::int32_t cell) {
  return distribution.cells().max_spacing(cell) == 0;
}

bool empty_leaf(const Distribution<3>& distribution, std::int32_t leaf) {
  return empty_cell(distribution, distribution.cell_of(leaf));
}

bool owns_something_in(const Distribution<3>& distribution, int rank, std::int32_t leaf) {
  return distribution.owner(leaf) == rank && !empty_leaf(distribution, leaf);
}

// The expected halo, computed from the boxes of all leaves and cells.
class BruteForce {
 public:
  BruteForce(const BackgroundTree<3>& tree, const std::vector<double>& d,
             const Distribution<3>& distribution)
      : distribution_(distribution), leaves_(index(tree.leaf_count())), near_(leaves_) {
    for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
      box_.push_back(tree.cell_box(tree.leaf_cell(leaf)));
      reach_.push_back(pnpbs::kRoomForGrowth * kRadius * d[index(leaf)]);
    }
    for (std::size_t a = 0; a < leaves_; ++a)
      for (std::size_t b = 0; b < leaves_; ++b) {
        const double reach = std::max(reach_[a], reach_[b]);
        if (a == b || (reach > 0 && pnpbs::squared_gap<3>(box_[a], box_[b]) <= reach * reach))
          near_[a].push_back(static_cast<std::int32_t>(b));
      }
    for (int r = 0; r < comm->size(); ++r) {
      hops_.push_back(hops_from(r));
      gap_.push_back(squared_gaps_to(r));
    }
  }

  int hops(int rank, std::size_t leaf) const { return hops_[index(rank)][leaf]; }
  const std::vector<std::int32_t>& near(std::size_t leaf) const { return near_[leaf]; }

  // Returns whether a rank that does not own the leaf needs it.
  bool needs(int rank, std::size_t leaf, int hops, double hop_share) const {
    const double way = hops * hop_share * max_reach_[leaf];
    return hops_[index(rank)][leaf] <= hops && gap_[index(rank)][leaf] <= way * way;
  }
  // Computes the largest reach of the leaves within this number of hops of each one.
  void find_max_reach(int hops) {
    max_reach_ = reach_;
    for (int hop = 0; hop < hops; ++hop) {
      const std::vector<double> before = max_reach_;
      for (std::size_t leaf = 0; leaf < leaves_; ++leaf)
        for (const std::int32_t other : near_[leaf])
          max_reach_[leaf] = std::max(max_reach_[leaf], before[index(other)]);
    }
  }

 private:
  // Returns the number of hops from each leaf to those of the rank.
  std::vector<int> hops_from(int rank) const {
    std::vector<int> hops(leaves_, kUnreached);
    std::vector<std::int32_t> front;
    for (std::size_t leaf = 0; leaf < leaves_; ++leaf)
      if (owns_something_in(distribution_, rank, static_cast<std::int32_t>(leaf))) {
        hops[leaf] = 0;
        front.push_back(static_cast<std::int32_t>(leaf));
      }
    for (std::size_t next = 0; next < front.size(); ++next)
      for (const std::int32_t other : near_[index(front[next])])
        if (hops[index(other)] == kUnreached) {
          hops[index(other)] = hops[index(front[next])] + 1;
          front.push_back(other);
        }
    return hops;
  }

  // Returns the squared distance from each leaf to the nearest cell of the rank.
  std::vector<double> squared_gaps_to(int rank) const {
    const BackgroundTree<3>& cells = distribution_.cells().tree();
    std::vector<double> gap(leaves_, std::numeric_limits<double>::infinity());
    for (std::int32_t c = 0; c < cells.leaf_count(); ++c) {
      if (distribution_.owner_of_cell(c) != rank || empty_cell(distribution_, c)) continue;
      const Box<3> cell = cells.cell_box(cells.leaf_cell(c));
      for (std::size_t leaf = 0; leaf < leaves_; ++leaf)
        gap[leaf] = std::min(gap[leaf], pnpbs::squared_gap<3>(box_[leaf], cell));
    }
    return gap;
  }

  const Distribution<3>& distribution_;
  std::size_t leaves_;
  std::vector<Box<3>> box_;
  std::vector<double> reach_, max_reach_;
  std::vector<std::vector<std::int32_t>> near_;
  std::vector<std::vector<int>> hops_;    // by rank
  std::vector<std::vector<double>> gap_;  // by rank
};

// ------------------------------------------------------------------ owners ---------------------

void check_owners(const BackgroundTree<3>& tree, const Distribution<3>& distribution) {
  std::uint64_t owners = 0;
  for (std::uint64_t p = 0; p < 5000; ++p) {
    Point<3> x;
    for (std::size_t k = 0; k < 3; ++k)
      x[k] = static_cast<double>(pnpbs::mixed(3 * p + k) >> 11) * 0x1p-53;
    const int owner = distribution.owner_at(x);
    const std::int32_t leaf = tree.leaf_at(x);
    expect(owner == distribution.owner(leaf), "a point's owner is that of its leaf");
    expect(distribution.owns(leaf) == (owner == comm->rank()), "owns");
    owners = pnpbs::mixed(owners ^ static_cast<std::uint64_t>(owner));
  }
  expect(comm->same_on_all(owners), "owners of points are the same on all ranks");
}

// Checks prefix sums of counts over leaves. Each rank counts leaf + 1 nodes in each leaf that it
// owns.
void check_prefix_sums(const Distribution<3>& distribution, std::int32_t leaves) {
  std::vector<std::int64_t> counts(index(leaves), 0);
  for (std::int32_t leaf = 0; leaf < leaves; ++leaf)
    if (distribution.owns(leaf)) counts[index(leaf)] = leaf + 1;
  std::int64_t start = 7;
  const std::vector<std::int64_t> sums = distribution.prefix_sums(*comm, counts, start);
  std::int64_t before = 7;
  for (std::int32_t leaf = 0; leaf < leaves; ++leaf) {
    expect(!distribution.owns(leaf) || sums[index(leaf)] == before, "sum over the leaves before");
    before += leaf + 1;
  }
  expect(start == before, "sum over all leaves");
}

// ------------------------------------------------------------------ halos ----------------------

void check_halo(Distribution<3>& distribution, BruteForce& brute, std::int32_t leaves, int hops,
                double hop_share) {
  const std::string what = std::to_string(hops) + " hops: ";
  brute.find_max_reach(hops);
  const pnpbs::Halo& halo = distribution.halo(hops, hop_share);
  std::vector<char> exchanged(index(leaves), 0), neighbour(index(comm->size()), 0);
  std::int64_t ghosts = 0;
  for (std::int32_t leaf = 0; leaf < leaves; ++leaf) {
    std::vector<int> ranks, wanted;
    halo.for_ranks(leaf, [&](int r) { ranks.push_back(r); });
    for (int r = 0; r < comm->size(); ++r) {
      if (r == distribution.owner(leaf) || empty_leaf(distribution, leaf)) continue;
      if (brute.needs(r, index(leaf), hops, hop_share)) wanted.push_back(r);
      if (owns_something_in(distribution, comm->rank(), leaf) &&
          brute.hops(r, index(leaf)) <= hops + 1)
        neighbour[index(r)] = 1;
    }
    const bool near = brute.hops(comm->rank(), index(leaf)) <= 1;
    std::vector<int> known = wanted;  // far from the own leaves only this rank's need is known
    if (!near) std::erase_if(known, [](int r) { return r != comm->rank(); });
    expect(ranks == known, what + "ranks that need a leaf");
    exchanged[index(leaf)] =
        !empty_leaf(distribution, leaf) && (!distribution.owns(leaf) || !wanted.empty());
    ghosts += std::count(wanted.begin(), wanted.end(), comm->rank());
  }
  for (std::int32_t leaf = 0; leaf < leaves; ++leaf) {
    const std::vector<std::int32_t>& near = brute.near(index(leaf));
    const bool interior = brute.hops(comm->rank(), index(leaf)) <= 1 &&
                          std::none_of(near.begin(), near.end(),
                                       [&](std::int32_t other) { return exchanged[index(other)]; });
    expect(halo.interior(leaf) == interior, what + "leaves that no exchange disturbs");
  }
  std::vector<int> wanted;
  for (int r = 0; r < comm->size(); ++r)
    if (neighbour[index(r)]) wanted.push_back(r);
  expect(halo.neighbours() == wanted, what + "ranks to exchange with");
  expect(comm->size() == 1 ? ghosts == 0 : ghosts > 0, what + "there are ghosts");
}

void check_reach(const Distribution<3>& distribution, const BruteForce& brute, int hops) {
  const std::vector<std::int32_t> found = distribution.hops_from_own(hops);
  for (std::size_t leaf = 0; leaf < found.size(); ++leaf) {
    const int wanted = brute.hops(comm->rank(), leaf);
    expect(wanted <= hops ? found[leaf] == wanted : found[leaf] == pnpbs::kUnreached,
           "hops from ours to each leaf");
  }
  expect(distribution.unrefined_within(hops).empty(), "all cells are refined");
}

// Checks the cells that a rank refines first, which are selected by the spacings of cells only.
// They must include all cells within a reach of the rank's own.
void check_cells_near_own(const Distribution<3>& distribution) {
  const BackgroundTree<3>& tree = distribution.cells().tree();
  const auto box = [&](std::int32_t c) { return tree.cell_box(tree.leaf_cell(c)); };
  const std::vector<char> found = distribution.cells_near_own(1, kRadius);
  for (std::int32_t a = 0; a < tree.leaf_count(); ++a) {
    if (distribution.owner_of_cell(a) != comm->rank() || empty_cell(distribution, a)) continue;
    for (std::int32_t b = 0; b < tree.leaf_count(); ++b) {
      const double reach = kRadius * std::max(distribution.cells().max_spacing(a),
                                              distribution.cells().max_spacing(b));
      if (!empty_cell(distribution, b) && pnpbs::squared_gap<3>(box(a), box(b)) <= reach * reach)
        expect(found[index(b)] != 0, "a cell near one of ours is found");
    }
  }
}

// The domains are the whole box, an oblique slab of it, and half of its leaves, so that paths
// between parts lead through empty cells.
bool in_box(const Point<3>&) { return true; }
bool in_slab(const Point<3>& x) { return std::fabs(x[0] + 0.5 * x[1] - 0.7) < 0.17; }

// Checks the owners of cells that a box touches.
void check_owners_in(const Distribution<3>& distribution) {
  const BackgroundTree<3>& tree = distribution.cells().tree();
  for (std::uint64_t n = 0; n < 200; ++n) {
    Box<3> box;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t random = pnpbs::mixed(3 * n + k);
      box.low[k] = 1.2 * static_cast<double>(random >> 11) * 0x1p-53 - 0.1;
      box.high[k] = box.low[k] + static_cast<double>(random % 100) * (n % 2 ? 0.001 : 0.005);
    }
    std::vector<char> wanted(index(comm->size()), 0), found = wanted;
    for (std::int32_t c = 0; c < tree.leaf_count(); ++c)
      if (!empty_cell(distribution, c) &&
          pnpbs::squared_gap<3>(box, tree.cell_box(tree.leaf_cell(c))) == 0)
        wanted[index(distribution.owner_of_cell(c))] = 1;
    distribution.for_owners_in(box, [&](int r) { found[index(r)] = 1; });
    expect(found == wanted, "owners of what a box touches");
  }
}

bool in_sponge(const Point<3>& x) {
  std::uint64_t hash = 5;
  for (const double coordinate : x) hash = pnpbs::mixed_with(hash, coordinate);
  return hash % 2 == 0;
}

void check_distribution(bool (*inside)(const Point<3>&)) {
  const BackgroundTree<3> tree = octree::refined_to(leaf_width);
  std::vector<double> d = octree::max_spacings(tree, spacing);
  const std::int32_t leaves = tree.leaf_count();
  for (std::int32_t leaf = 0; leaf < leaves; ++leaf)
    if (!inside(tree.cell_centre(tree.leaf_cell(leaf)))) d[index(leaf)] = 0;
  Distribution<3> distribution = octree::distributed(*comm, tree, d, kRadius);
  check_owners(tree, distribution);
  check_prefix_sums(distribution, leaves);
  check_cells_near_own(distribution);
  check_owners_in(distribution);
  BruteForce brute(tree, d, distribution);
  for (int hops = 0; hops < 4; ++hops) check_reach(distribution, brute, hops);
  check_halo(distribution, brute, leaves, 1, 1);
  check_halo(distribution, brute, leaves, 2, 1 / pnpbs::kRoomForGrowth);
  check_halo(distribution, brute, leaves, 3, 0.5);
  if (comm->rank() == 0) std::printf("%d leaves\n", leaves);
}

void check_all() {
  check_distribution(in_box);
  check_distribution(in_slab);
  check_distribution(in_sponge);
}

}  // namespace

int main(int argc, char** argv) { return rank_checks::run_in_groups(argc, argv, check_all); }
