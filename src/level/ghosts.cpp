// SPDX-License-Identifier: BSD-3-Clause
// The level over several ranks: how nodes travel.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "comm/records.hpp"
#include "level/level.hpp"
#include "partition/node_exchange.hpp"

namespace pnpbs {

namespace {

// Ghosts are chosen anew after so many steps, because nodes drift.
constexpr std::int64_t kGhostLife = 20;

}  // namespace

// How many hops of the leaf graph the ghosts must reach for owned nodes to stay exact over so many
// force evaluations. What an evaluation brings in comes from no farther than the range of the force
// and the ways of both nodes; a hop spans a list radius. Both nodes drift while the ghosts stay the
// same ones.
int Level::hops_for(std::int64_t evaluations) const {
  const double most = settings_.motion.most;
  const auto n = static_cast<double>(evaluations);
  const double drift = 2 * most * static_cast<double>(ghost_life());
  const double needed = n * (settings_.force_range() + 2 * most) + drift;
  const int hops = static_cast<int>(std::ceil(needed / settings_.list_radius));
  return std::max(0, hops - static_cast<int>(settings_.halo_deficit));
}

const Halo& Level::halo_of(int hops) {
  return distribution_.halo(hops, settings_.list_radius / (kRoomForGrowth * widest_radius()));
}

int Level::step_hops() const {
  return hops_for(settings_.exchange_interval * settings_.evaluations_per_step());
}

int Level::deepest_hops() const {
  // One more because nodes drift out of their leaves, and one to see who is beyond.
  return std::max({step_hops(), hops_for(kRungeKuttaStages), kPopulationHops, kRepairHops}) + 2;
}

std::int64_t Level::ghost_life() const { return std::max(kGhostLife, settings_.exchange_interval); }

// Before the steps until the next exchange. Between agreements only positions and velocities
// travel, in buffers that are there: a rank that has failed meanwhile sends what it has.
void Level::exchange_for_steps(std::exception_ptr& failure) {
  if (!distributed()) return;
  if (!ghosts_can_stay(step_hops())) {
    agree_on_failure(*comm_, failure);
    exchange(step_hops());
  } else {
    renew_ghosts();
  }
}

bool Level::ghosts_can_stay(int hops) const {
  return ghost_hops_ >= hops && steps_since_choice_ + settings_.exchange_interval <= ghost_life();
}

// The same ghosts, exact again.
void Level::renew_ghosts() {
  if (ghosts_exact_ || !distributed()) return;
  const PhaseTimer timer(timers_, Phase::exchange);
  plan_.update(*comm_, nodes_);
  ghosts_exact_ = true;
}

// Owned nodes go to the ranks that own their leaves by now, and ghosts are chosen anew. Where ranks
// can agree: on the halo before it, which a first use has to find, and that it went well. A rank
// that fails within has its messages come and go, but empty: its neighbours must not wait.
void Level::exchange(int hops) {
  ++version_;
  if (!distributed()) return;
  if (hops + 2 > tree_hops_) adopt(distribution_);  // deeper than was asked for so far
  const PhaseTimer timer(timers_, Phase::exchange);
  ghost_hops_ = 0;
  std::vector<Bytes> outgoing, incoming;
  agreed(*comm_, [&] {
    plan_.start(halo_of(hops).neighbours(), comm_->size());
    outgoing.resize(halo_of(hops).neighbours().size());
  });
  const Halo& halo = halo_of(hops);
  std::exception_ptr failure;
  const NodeExchange<2> travel{map_.tree(), distribution_, halo, comm_->rank(), plan_};
  attempt(failure, [&] {
    const auto known_leaf = [this](std::int64_t i) {
      return buckets_.knows(i) ? buckets_.bucket_of(i) : -1;
    };
    const View<std::int32_t> stay = nodes_.order_scratch();
    keep_nodes(stay, travel.pack_leaving(nodes_, known_leaf, outgoing, stay));
  });
  if (failure)
    for (Bytes& bytes : outgoing) bytes.clear();
  try {
    incoming = comm_->exchange(halo.neighbours(), outgoing);
  } catch (...) {
    failure = std::current_exception();
  }
  attempt(failure, [&] { travel.append_arriving(nodes_, incoming); });
  lists_valid_ = false;
  agree_on_failure(*comm_, failure);
  ghost_hops_ = hops;
  ghosts_exact_ = true;
  steps_since_choice_ = 0;
}

// Owned nodes go to their owners by a new partition, however far; there are no ghosts until the
// next exchange.
void Level::migrate() {
  const PhaseTimer timer(timers_, Phase::exchange);
  std::vector<PackedNode<2>> leaving;
  const View<std::int32_t> stay = nodes_.order_scratch();
  std::int64_t kept = 0;
  const auto owner_at = [this](const PackedNode<2>& node) {
    return distribution_.owner_at(node.x);
  };
  for (std::int64_t i = 0; i < nodes_.count; ++i) {
    if (!nodes_.owned(i)) continue;
    if (distribution_.owner_at(nodes_.position(i)) == comm_->rank())
      stay(kept++) = static_cast<std::int32_t>(i);
    else
      leaving.push_back(packed(nodes_, i));
  }
  const std::vector<PackedNode<2>> arriving = redistribute(*comm_, leaving, owner_at);
  agreed(*comm_,
         [&] { nodes_.reserve_with_room(kept + static_cast<std::int64_t>(arriving.size())); });
  keep_nodes(stay, kept);
  for (const PackedNode<2>& node : arriving) append(nodes_, node, true);
  ++version_;
  ghost_hops_ = 0;
  lists_valid_ = false;
}

// Every node to the rank that owns its place, from wherever it is; most are there already.
void Level::scatter_to_owners(GivenNodes& given) const {
  if (!distributed()) return;
  const auto owner_of = [this](const GivenNode& node) {
    return distribution_.owner_at(node.position);
  };
  const View<std::int32_t> owner =
      make_view<std::int32_t>("pnpbs::Level::owner", static_cast<std::int64_t>(given.size()));
  for_each("pnpbs::Level::find_owners", static_cast<std::int64_t>(given.size()),
           [&](std::int64_t k) { owner(k) = owner_of(given[static_cast<std::size_t>(k)]); });
  std::vector<GivenNode> leaving;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < given.size(); ++k) {
    if (owner(k) == comm_->rank())
      given[kept++] = given[k];
    else
      leaving.push_back(given[k]);
  }
  given.resize(kept);
  const std::vector<GivenNode> arrived = redistribute<GivenNode>(*comm_, leaving, owner_of);
  given.insert(given.end(), arrived.begin(), arrived.end());
}

GivenNodes Level::owned_nodes() const {
  GivenNodes owned;
  owned.reserve(static_cast<std::size_t>(owned_count()));
  for (std::int64_t i = 0; i < nodes_.count; ++i)
    if (nodes_.owned(i))
      owned.push_back({nodes_.position(i), nodes_.id(i), nodes_.moves(i), -1, nodes_.d(i)});
  return owned;
}

std::int64_t Level::owned_count() const {
  return static_cast<std::int64_t>(sum_of("pnpbs::Level::owned_count", nodes_.count,
                                          [this](std::int64_t i) { return nodes_.owned(i); }));
}

}  // namespace pnpbs
