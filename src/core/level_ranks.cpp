// SPDX-License-Identifier: BSD-3-Clause
// The level over several ranks: who owns what, and how nodes travel.
#include <cmath>
#include <cstring>

#include "core/level.hpp"
#include "parallel/partition.hpp"
#include "parallel/records.hpp"

namespace pnpbs {

namespace {

// d may grow by this factor above its samples in a leaf before ghosts could be missing.
constexpr double kRoomForGrowth = 1.25;

// A node on its way to another rank.
struct PackedNode {
  std::int64_t id;
  double x[2], v[2], anchor[2], d;
  std::int32_t tag, boundary_node;
};

}  // namespace

void Level::distribute() {
  if (!distributed()) return;
  const PhaseTimer timer(timers_, Phase::partition);
  const BackgroundTree<2>& tree = map_.tree();
  std::vector<double> reach;
  std::vector<std::int64_t> work;
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    const bool outside = map_.leaf_outside(leaf);
    const double side = tree.cell_side(tree.leaf_cell(leaf)), d = map_.leaf_spacing(leaf);
    reach.push_back(outside ? 0
                            : kRoomForGrowth * widest_radius() * map_.leaf_largest_spacing(leaf));
    // Nodes to be expected, in sixteenths.
    work.push_back(outside ? 0 : 1 + static_cast<std::int64_t>(16 * side * side / (d * d)));
  }
  interaction_.build(tree, reach);
  std::vector<std::int32_t> owner;
  if (comm_->rank() == 0)
    owner = partition_leaves(interaction_, work, comm_->size(), settings_.metis_seed);
  Bytes bytes(owner.size() * sizeof(std::int32_t));
  if (!bytes.empty()) std::memcpy(bytes.data(), owner.data(), bytes.size());
  comm_->broadcast(bytes, 0);
  owner.resize(bytes.size() / sizeof(std::int32_t));
  std::memcpy(owner.data(), bytes.data(), bytes.size());
  distribution_ = Distribution(&interaction_, std::move(owner), comm_->rank());
}

// How many hops of the leaf graph the ghosts must reach for owned nodes to stay exact until the
// next exchange. A hop spans at least kRoomForGrowth list radii of d; what a force evaluation
// brings in comes from no farther than the range of the force and the ways of both nodes.
int Level::step_hops() const {
  const double per_step =
      settings_.evaluations_per_step() * (settings_.force_range() + 2 * settings_.motion.most);
  const double needed = static_cast<double>(settings_.exchange_interval) * per_step;
  const int hops =
      1 + static_cast<int>(std::ceil(needed / (kRoomForGrowth * settings_.list_radius)));
  return std::max(0, hops - static_cast<int>(settings_.halo_deficit));
}

// At an event, where ranks can agree: on the ghost layers before it, which a first use has to find,
// and that it went well.
void Level::exchange(int hops) {
  if (!distributed()) {
    ++version_;
    return;
  }
  agreed(*comm_, [&] { distribution_.halo(hops); });
  std::exception_ptr failure;
  exchange(hops, failure);
  agree_on_failure(*comm_, failure);
}

// Between agreements. A rank that has failed, before or here, has its messages come and go as
// before, but empty: its neighbours must not wait.
void Level::exchange(int hops, std::exception_ptr& failure) {
  ++version_;
  if (!distributed()) return;
  const PhaseTimer timer(timers_, Phase::exchange);
  const auto attempt = [&](const auto& work) {
    try {
      if (!failure) work();
    } catch (...) {
      failure = std::current_exception();
    }
  };
  const Halo& halo = distribution_.halo(hops);
  std::vector<Bytes> outgoing(halo.neighbours().size()), incoming;
  attempt([&] { pack_leaving(halo, outgoing); });
  if (failure) outgoing.assign(outgoing.size(), {});
  try {
    incoming = comm_->exchange(halo.neighbours(), outgoing);
  } catch (...) {
    failure = std::current_exception();
  }
  attempt([&] { append_arriving(incoming); });
  lists_valid_ = false;
}

// Packs what other ranks own by now or have as ghosts, and keeps what is ours or our ghost.
void Level::pack_leaving(const Halo& halo, std::vector<Bytes>& outgoing) {
  const BackgroundTree<2>& tree = map_.tree();
  const std::vector<int> place = places_of(halo.neighbours(), comm_->size());
  View<std::int32_t> stay = make_view<std::int32_t>("pnpbs::Level::stay", nodes_.count);
  std::int64_t kept = 0;
  for (std::int64_t i = 0; i < nodes_.count; ++i) {
    if (!nodes_.owned(i)) continue;
    const std::int32_t leaf = tree.leaf_at(nodes_.position(i));
    const PackedNode packed{nodes_.id(i),
                            {nodes_.x[0](i), nodes_.x[1](i)},
                            {nodes_.v[0](i), nodes_.v[1](i)},
                            {nodes_.anchor[0](i), nodes_.anchor[1](i)},
                            nodes_.d(i),
                            nodes_.tag(i),
                            nodes_.boundary_node(i)};
    halo.for_ranks(leaf, [&](int r) {
      if (r == comm_->rank())
        stay(kept++) = static_cast<std::int32_t>(i);
      else if (place[static_cast<std::size_t>(r)] >= 0)
        pack(outgoing[static_cast<std::size_t>(place[static_cast<std::size_t>(r)])], packed);
    });
    nodes_.owned(i) = distribution_.owns(leaf);
  }
  nodes_.permute(stay, kept);
}

void Level::append_arriving(const std::vector<Bytes>& incoming) {
  std::size_t arriving = 0;
  for (const Bytes& bytes : incoming) arriving += bytes.size() / sizeof(PackedNode);
  nodes_.reserve(nodes_.count + static_cast<std::int64_t>(arriving));
  for_records<PackedNode>(incoming, [&](const PackedNode& packed) {
    const Point<2> x{packed.x[0], packed.x[1]};
    nodes_.append(x, packed.d, packed.id, packed.tag, packed.boundary_node);
    const std::int64_t i = nodes_.count - 1;
    for (int k = 0; k < 2; ++k) {
      nodes_.v[k](i) = packed.v[k];
      nodes_.anchor[k](i) = packed.anchor[k];
    }
    nodes_.owned(i) = distribution_.owns(map_.tree().leaf_at(x));
  });
}

// Every node to the rank that owns its leaf, from wherever it is.
void Level::scatter_to_owners(std::vector<GivenNode>& given) const {
  if (!distributed()) return;
  given = delivered<GivenNode>(*comm_, given, [this](const GivenNode& node) {
    return distribution_.owner(map_.tree().leaf_at(node.position));
  });
}

std::vector<GivenNode> Level::owned_nodes() const {
  std::vector<GivenNode> owned;
  for (std::int64_t i = 0; i < nodes_.count; ++i)
    if (nodes_.owned(i))
      owned.push_back({nodes_.position(i), nodes_.id(i), nodes_.moves(i), nodes_.d(i)});
  return owned;
}

std::int64_t Level::owned_count() const {
  return static_cast<std::int64_t>(sum_of("pnpbs::Level::owned_count", nodes_.count,
                                          [this](std::int64_t i) { return nodes_.owned(i); }));
}

}  // namespace pnpbs
