// SPDX-License-Identifier: BSD-3-Clause
// Tests that a body-centred cubic lattice with random displacements in a box relaxes over the ranks
// to the same bits as on one rank, and does not if the ghost layer is too thin. Under this law the
// lattice is not at rest, since its eight nearest neighbours are compressed. So nodes continue to
// move when the displacements have decayed, and errors of the ghosts have an effect at all times.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/mixed_hash.hpp"
#include "box_nodes.hpp"
#include "dynamics/pair_laws.hpp"
#include "rank_checks.hpp"

namespace {

using octree::Point;
using pnpbs::Communicator;
using PackedNode = pnpbs::PackedNode<3>;
using rank_checks::comm;
using rank_checks::expect;

// These values are the defaults of a placement.
constexpr pnpbs::LinearPush kLaw{1, 1.06};
constexpr pnpbs::Motion kMotion{0.8, 0.2, 0.03};
constexpr double kListRadius = 1.7;
constexpr int kSteps = 100, kExchangeInterval = 4, kGhostLife = 20;  // in steps

// ------------------------------------------------------------------ the lattice ----------------

constexpr int kCells = 25;                 // along the box
constexpr double kEdge = 1.0 / kCells;     // of a cubic cell, with nodes at a corner and the centre
constexpr double kJitter = 0.3;            // in spacings, along each axis
constexpr double kFixedRim = 1.5 * kEdge;  // three layers of nodes

// Returns a spacing that is slightly larger on one side. On average it is the distance of nearest
// nodes.
double spacing(const Point<3>& x) { return 0.5 * std::sqrt(3.0) * kEdge * (0.97 + 0.06 * x[0]); }

// Returns the width of leaves, which is smaller in one half of the box, so that hops have different
// lengths.
double leaf_width(const Point<3>& x) { return (x[2] < 0.5 ? 2 : 4) * spacing(x); }

double jitter(std::int64_t id, int k) {
  const std::uint64_t bits =
      pnpbs::mixed(3 * static_cast<std::uint64_t>(id) + static_cast<std::uint64_t>(k));
  return kJitter * (2 * static_cast<double>(bits >> 11) * 0x1p-53 - 1);
}

PackedNode lattice_node(std::int64_t id) {
  const std::int64_t cell = id / 2;
  const double offset = id % 2 == 0 ? 0.25 : 0.75;
  const Point<3> site{kEdge * (static_cast<double>(cell / (kCells * kCells)) + offset),
                      kEdge * (static_cast<double>(cell / kCells % kCells) + offset),
                      kEdge * (static_cast<double>(cell % kCells) + offset)};
  PackedNode node{id, site, {}, site, spacing(site), 0, -1, -1, pnpbs::Carrier::free};
  for (const double x : site)
    if (x < kFixedRim || x > 1 - kFixedRim) node.carrier = pnpbs::Carrier::fixed;
  if (node.carrier == pnpbs::Carrier::free)
    for (int k = 0; k < 3; ++k) node.x[static_cast<std::size_t>(k)] += node.d * jitter(id, k);
  return node;
}

// ------------------------------------------------------------------ the time loop --------------

// Returns the number of hops of the leaf graph that the ghosts must cover. A step depends on nodes
// within the range of the force plus the moves of both nodes. Both nodes drift as long as the set
// of ghosts is unchanged. A hop spans a list radius.
int hops_needed() {
  const double step = kLaw.range + 2 * kMotion.max_move, drift = 2 * kMotion.max_move * kGhostLife;
  return static_cast<int>(std::ceil((kExchangeInterval * step + drift) / kListRadius));
}

struct Relaxed {
  std::uint64_t hash = 0;        // of ids and coordinates of all nodes
  double min_gap = kListRadius;  // distance of two nodes over the desired one
  std::uint64_t nodes = 0;
  std::uint64_t held = 0;  // in the last step, including ghosts
};

Relaxed measured(const Communicator& ranks, BoxNodes& box) {
  Relaxed result;
  result.held = ranks.allreduce_sum(static_cast<std::uint64_t>(box.nodes().count));
  box.exchange(hops_needed());
  box.rebuild_lists();
  const pnpbs::Nodes<3>& nodes = box.nodes();
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    if (!nodes.owned(i)) continue;
    ++result.nodes;
    std::uint64_t hash = pnpbs::mixed(static_cast<std::uint64_t>(nodes.id(i)));
    for (const double x : nodes.position(i)) hash = pnpbs::mixed_with(hash, x);
    result.hash += hash;
    box.lists().for_neighbours(i, [&](std::int64_t j) {
      const double desired = 0.5 * (nodes.d(i) + nodes.d(j));
      const double gap = pnpbs::distance<3>(nodes.position(i), nodes.position(j)) / desired;
      result.min_gap = std::min(result.min_gap, gap);
    });
  }
  result.hash = ranks.allreduce_sum(result.hash);
  result.nodes = ranks.allreduce_sum(result.nodes);
  result.min_gap = -ranks.allreduce_max(-result.min_gap);
  return result;
}

Relaxed relax(const std::shared_ptr<const Communicator>& ranks, int steps, int hops) {
  BoxNodes box(ranks, spacing, leaf_width, kListRadius);
  std::vector<PackedNode> given;
  for (std::int64_t id = ranks->rank(); id < 2 * kCells * kCells * kCells; id += ranks->size())
    given.push_back(lattice_node(id));
  box.add(given);
  for (int step = 0; step < steps; ++step) {
    if (step % kGhostLife == 0)
      box.exchange(hops);
    else if (step % kExchangeInterval == 0)
      box.update_ghosts();
    if (box.lists_may_miss_a_pair(kLaw.range)) box.rebuild_lists();
    box.step(kLaw, kMotion);
  }
  return measured(*ranks, box);
}

// ------------------------------------------------------------------ checks ---------------------

void print(const char* what, const Relaxed& relaxed) {
  if (comm->rank() == 0)
    std::printf("%s: %llu nodes, hash %016llx, least gap %.3f, %llu held\n", what,
                static_cast<unsigned long long>(relaxed.nodes),
                static_cast<unsigned long long>(relaxed.hash), relaxed.min_gap,
                static_cast<unsigned long long>(relaxed.held));
}

void check_relaxation() {
  const int hops = hops_needed();
  const Relaxed before = relax(comm, 0, hops), after = relax(comm, kSteps, hops);
  print("before", before);
  print("after", after);
  expect(after.nodes == 2 * kCells * kCells * kCells, "all nodes are there");
  expect(after.min_gap > 0.8 && before.min_gap < 0.4, "the jitter is gone");
  std::uint64_t alone = 0;
  if (comm->rank() == 0) alone = relax(pnpbs::serial_communicator(), kSteps, hops).hash;
  alone = comm->allreduce_sum(alone);  // only the first rank contributes a value other than 0
  expect(after.hash == alone, "the same bits as on one rank");
  if (comm->size() == 1) return;
  // The number of hops is a bound for the worst case and may exceed the need by one, so two fewer
  // are tested.
  const Relaxed thin = relax(comm, kSteps, hops - 2);
  print("too thin a halo", thin);
  expect(thin.hash != alone, "a halo that is too thin is noticed");
}

}  // namespace

int main(int argc, char** argv) { return rank_checks::run_in_groups(argc, argv, check_relaxation); }
