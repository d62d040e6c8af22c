// SPDX-License-Identifier: BSD-3-Clause
// Tests the migration of nodes in space: each arrives once, with all its bits, on the rank that
// owns its position. Ghosts equal their owners after updates, permutations and drift.
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "base/mixed_hash.hpp"
#include "box_nodes.hpp"
#include "rank_checks.hpp"

namespace {

using octree::Point;
using PackedNode = pnpbs::PackedNode<3>;
using rank_checks::comm;
using rank_checks::expect;

constexpr std::int64_t kNodes = 20000;
constexpr int kHops = 2;
constexpr double kRadius = 1.7, kMin = 0.03;  // radius of the lists; spacing
// Largest drift of nodes between two exchanges. It is less than a hop, as in a placement.
constexpr double kDrift = 0.6 * kRadius * kMin;

double spacing(const Point<3>& x) { return kMin + 0.05 * pnpbs::distance<3>(x, {0.3, 0.4, 0.6}); }

double leaf_width(const Point<3>& x) { return 4 * spacing(x); }

// Returns a pseudo-random number in [0, 1) from the id of a node and the number of a value.
double number(std::int64_t id, int value) {
  const std::uint64_t bits =
      pnpbs::mixed(64 * static_cast<std::uint64_t>(id) + static_cast<std::uint64_t>(value));
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

// Returns the state of node `id` at a moment, which depends on these two only. Some nodes have
// values that messages leave out, each independently of the others.
PackedNode node_at(std::int64_t id, int moment) {
  const auto one_in = [&](int n, int value) { return number(id, value) * n < 1; };
  const bool at_rest = moment == 0 && one_in(2, 55), was_here = one_in(2, 56);
  PackedNode node;
  node.id = id;
  for (int k = 0; k < 3; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double way = moment == 0 ? 0 : kDrift * (number(id, 3 * moment + k) - 0.5);
    node.x[at] = number(id, k) + way;
    node.v[at] = at_rest ? 0 : number(id, 20 + 3 * moment + k) - 0.5;
    node.reference[at] = number(id, was_here ? k : 40 + k);
  }
  node.d = kMin * (1 + 0.1 * number(id, 50));
  node.tag = one_in(2, 57) ? 0 : static_cast<std::int32_t>(100 * number(id, 51));
  node.boundary_node = one_in(2, 58) ? -1 : static_cast<std::int32_t>(10 * number(id, 52)) - 8;
  node.reference_on =
      one_in(2, 59) ? node.boundary_node : static_cast<std::int32_t>(10 * number(id, 54)) - 8;
  node.carrier = number(id, 53) < 0.5 ? pnpbs::Carrier::free : pnpbs::Carrier::fixed;
  return node;
}

bool same(const PackedNode& a, const PackedNode& b) {
  return a.id == b.id && a.x == b.x && a.v == b.v && a.reference == b.reference && a.d == b.d &&
         a.tag == b.tag && a.boundary_node == b.boundary_node && a.reference_on == b.reference_on &&
         a.carrier == b.carrier;
}

// Expects that all owned nodes and ghosts have the state of this moment.
void check_values(BoxNodes& box, int moment, const std::string& when) {
  for (std::int64_t i = 0; i < box.nodes().count; ++i)
    expect(same(pnpbs::packed(box.nodes(), i), node_at(box.nodes().id(i), moment)),
           when + ": all bits of a node");
}

// Expects that every node has one owner by its position, and is a ghost on the ranks of the halo.
void check_who_has_it(BoxNodes& box, int moment, bool with_ghosts, const std::string& when) {
  std::vector<int> wanted(kNodes, 0), found(kNodes, 0);  // 1: a ghost, 2: owned
  for (std::int64_t id = 0; id < kNodes; ++id) {
    const std::int32_t leaf = box.tree().leaf_at(node_at(id, moment).x);
    int& here = wanted[static_cast<std::size_t>(id)];
    if (with_ghosts)
      box.halo(kHops).for_ranks(leaf, [&](int r) { here = r == comm->rank() ? 1 : here; });
    if (box.distribution().owner(leaf) == comm->rank()) here = 2;
  }
  for (std::int64_t i = 0; i < box.nodes().count; ++i)
    found[static_cast<std::size_t>(box.nodes().id(i))] += box.nodes().owned(i) ? 2 : 1;
  expect(found == wanted, when + ": owned nodes and ghosts");
  const auto owned = static_cast<std::uint64_t>(std::count(found.begin(), found.end(), 2)),
             ghosts = static_cast<std::uint64_t>(std::count(found.begin(), found.end(), 1));
  expect(comm->allreduce_sum(owned) == kNodes, when + ": each node once");
  expect(comm->allreduce_sum(ghosts) > 0 || !with_ghosts || comm->size() == 1,
         when + ": there are ghosts");
}

// Moves owned nodes to their state of a later moment. Their ghosts follow only at an update.
void move_owned(BoxNodes& box, int moment) {
  pnpbs::Nodes<3>& nodes = box.nodes();
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    if (!nodes.owned(i)) continue;
    const PackedNode node = node_at(nodes.id(i), moment);
    nodes.set_position(i, node.x);
    for (int k = 0; k < 3; ++k) nodes.v[k](i) = node.v[static_cast<std::size_t>(k)];
  }
}

void check_nodes() {
  BoxNodes box(comm, spacing, leaf_width, kRadius);
  std::vector<PackedNode> given;
  for (std::int64_t id = 0; id < kNodes; ++id)
    if (static_cast<int>(number(id, 60) * comm->size()) == comm->rank())
      given.push_back(node_at(id, 0));
  box.add(given);
  check_values(box, 0, "after migration");
  check_who_has_it(box, 0, false, "after migration");
  box.exchange(kHops);
  check_values(box, 0, "after the first exchange");
  check_who_has_it(box, 0, true, "after the first exchange");
  move_owned(box, 1);
  box.update_ghosts();
  check_values(box, 1, "after an update");
  const std::int64_t first = box.nodes().id(0), last = box.nodes().id(box.nodes().count - 1);
  box.rebuild_lists();
  expect(box.nodes().id(0) != first || box.nodes().id(box.nodes().count - 1) != last,
         "the nodes have got another order");
  check_values(box, 1, "after a permutation");
  move_owned(box, 2);
  box.update_ghosts();
  check_values(box, 2, "after an update in another order");
  box.exchange(kHops);  // some nodes change owners
  check_values(box, 2, "after the second exchange");
  check_who_has_it(box, 2, true, "after the second exchange");
  move_owned(box, 3);
  box.update_ghosts();
  check_values(box, 3, "after an update of new ghosts");
}

}  // namespace

int main(int argc, char** argv) { return rank_checks::run_in_groups(argc, argv, check_nodes); }
