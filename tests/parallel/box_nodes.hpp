// SPDX-License-Identifier: BSD-3-Clause
// The nodes of a rank in a box that is partitioned over the ranks, with their ghosts and adjacency
// lists. This is a reduced version of the code by which a level maintains them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "dynamics/schemes.hpp"
#include "neighbors/adjacency_list.hpp"
#include "neighbors/buckets.hpp"
#include "octree_on_ranks.hpp"
#include "partition/node_exchange.hpp"

// A visibility rule in which all bubbles see each other.
struct OpenSight {
  bool may_occlude(std::int64_t) const { return false; }
  bool visible(std::int64_t, std::int64_t) const { return true; }
};

class BoxNodes {
 public:
  using PackedNode = pnpbs::PackedNode<3>;

  // Leaves are at most `leaf_width` wide; lists contain pairs within the radius.
  BoxNodes(std::shared_ptr<const pnpbs::Communicator> comm, const octree::Function& spacing,
           const octree::Function& leaf_width, double radius)
      : comm_(std::move(comm)),
        radius_(radius),
        tree_(octree::refined_to(leaf_width)),
        distribution_(
            octree::distributed(*comm_, tree_, octree::max_spacings(tree_, spacing), radius)) {
    nodes_.reserve(1);
  }
  BoxNodes(const BoxNodes&) = delete;  // the distribution points to the tree
  BoxNodes& operator=(const BoxNodes&) = delete;

  pnpbs::Nodes<3>& nodes() { return nodes_; }
  const pnpbs::BackgroundTree<3>& tree() const { return tree_; }
  const pnpbs::Distribution<3>& distribution() const { return distribution_; }
  const pnpbs::AdjacencyList<3>& lists() const { return lists_; }

  // Sends nodes, from any rank, to their owners. Collective.
  void add(const std::vector<PackedNode>& given) {
    const auto owner = [this](const PackedNode& node) { return distribution_.owner_at(node.x); };
    for (const PackedNode& node : pnpbs::redistribute(*comm_, given, owner))
      pnpbs::append(nodes_, node, true);
  }

  // Migrates nodes to the ranks that own their current positions, and selects the ghosts again.
  // Collective.
  void exchange(int hops) {
    if (comm_->size() == 1) return;
    const pnpbs::Halo& halo = this->halo(hops);
    plan_.start(*comm_, {}, halo.neighbours());
    std::vector<pnpbs::Bytes> outgoing(halo.neighbours().size());
    const pnpbs::NodeExchange<3> travel{tree_, distribution_, halo, comm_->rank(), plan_, {}};
    const auto known_leaf = [this](std::int64_t i) {
      return buckets_.knows(i) ? buckets_.bucket_of(i) : -1;
    };
    pnpbs::View<std::int32_t>& stay = nodes_.order_scratch();
    const std::int64_t kept = travel.pack_leaving(nodes_, known_leaf, outgoing, stay);
    nodes_.keep(stay, kept);
    buckets_.keep(stay, kept);
    travel.append_arriving(nodes_, comm_->exchange(halo.neighbours(), outgoing, nullptr));
    lists_valid_ = false;
  }

  // Updates the positions and velocities of the current ghosts from their owners.
  void update_ghosts() {
    if (comm_->size() == 1) return;
    plan_.prepare_updates();
    plan_.update(nodes_, {});
  }

  const pnpbs::Halo& halo(int hops) { return distribution_.halo(hops, 1 / pnpbs::kRoomForGrowth); }

  // Returns whether a pair that is not in the lists may have come within the range of the force.
  // Each of the two nodes may have moved half of the distance.
  bool lists_may_miss_a_pair(double range) const {
    if (!lists_valid_) return true;
    const double square =
        pnpbs::max_of("BoxNodes::travelled", nodes_.count, 0.0, [this](std::int64_t i) {
          return pnpbs::squared_distance<3>(nodes_.position(i), pnpbs::point_at<3>(listed_, i)) /
                 (nodes_.d(i) * nodes_.d(i));
        });
    return std::sqrt(square) > 0.5 * (radius_ - range);
  }

  void rebuild_lists() {
    if (buckets_.sort(tree_, nodes_, radius_)) plan_.permute(buckets_.order(), nodes_.count);
    lists_.build(nodes_, buckets_, radius_, OpenSight{});
    pnpbs::reserve_field<3>(listed_, "BoxNodes::listed", nodes_.capacity());
    pnpbs::reserve_field<3>(next_, "BoxNodes::next", nodes_.capacity());
    for (int k = 0; k < 3; ++k) {
      for (std::int64_t i = 0; i < nodes_.count; ++i) listed_[k](i) = nodes_.x[k](i);
      // Lists are padded with the index behind the last node, which is a node far away.
      nodes_.x[k](nodes_.count) = pnpbs::kFarAway;
      next_[k](nodes_.count) = pnpbs::kFarAway;
    }
    nodes_.d(nodes_.count) = 1;
    lists_valid_ = true;
  }

  template <class Law>
  void step(const Law& law, const pnpbs::Motion& motion) {
    pnpbs::damped_step<3>(nodes_, lists_, law, motion, next_);
    std::swap(nodes_.x, next_);
  }

 private:
  std::shared_ptr<const pnpbs::Communicator> comm_;
  double radius_;
  pnpbs::BackgroundTree<3> tree_;
  pnpbs::Distribution<3> distribution_;
  pnpbs::Nodes<3> nodes_;
  pnpbs::Buckets<3> buckets_;
  pnpbs::AdjacencyList<3> lists_;
  pnpbs::HaloExchange<3> plan_;
  pnpbs::Field<3> next_, listed_;
  bool lists_valid_ = false;
};
