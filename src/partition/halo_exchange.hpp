// SPDX-License-Identifier: BSD-3-Clause
// A halo exchange plan: the owned nodes that each neighbour has as ghosts, and the owner of each
// ghost. Until the plan is built again, one message to and from each neighbour updates the ghosts'
// positions and velocities, in persistent buffers, which exist from the first update on.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "base/nodes.hpp"
#include "comm/communicator.hpp"
#include "comm/rank_indices.hpp"
#include "partition/image_ranks.hpp"
#include "partition/packed_node.hpp"

namespace pnpbs {

template <int Dim>
class HaloExchange {
 public:
  HaloExchange() = default;
  // Copies and moves keep the lists only.
  HaloExchange(const HaloExchange& other)
      : images_(other.images_),
        neighbours_(other.neighbours_),
        places_(other.places_),
        order_(other.order_),
        send_(other.send_),
        receive_(other.receive_),
        comm_(other.comm_) {}
  HaloExchange(HaloExchange&& other) noexcept { *this = std::move(other); }
  HaloExchange& operator=(const HaloExchange& other) { return *this = HaloExchange(other); }
  HaloExchange& operator=(HaloExchange&& other) noexcept {
    exchange_.reset();
    comm_ = other.comm_;
    images_ = other.images_;
    neighbours_ = std::move(other.neighbours_);
    places_ = std::move(other.places_);
    order_ = std::move(other.order_);
    send_ = std::move(other.send_);
    receive_ = std::move(other.receive_);
    return *this;
  }
  ~HaloExchange() = default;

  // Starts a plan for these neighbours without nodes. `comm` must outlive the plan.
  void start(const Communicator& comm, const ImageRanks<Dim>& images,
             const std::vector<int>& neighbours) {
    comm_ = &comm;
    images_ = images;
    exchange_.reset();
    outgoing_ = {};
    incoming_ = {};
    neighbours_ = neighbours;
    places_ = {};
    for (const int rank : neighbours) places_.add(rank);
    send_.assign(neighbours.size(), {});
    receive_.assign(neighbours.size(), {});
    order_messages();
  }
  // Adds a neighbour unless it is one. The other rank must do the same.
  void add_neighbour(int rank) {
    if (knows(rank)) return;
    places_.add(rank);
    neighbours_.push_back(rank);
    send_.emplace_back();
    receive_.emplace_back();
  }
  bool knows(int rank) const { return places_.of(rank) >= 0; }
  std::size_t place(int rank) const { return static_cast<std::size_t>(places_.of(rank)); }
  const std::vector<int>& neighbours() const { return neighbours_; }
  const ImageRanks<Dim>& images() const { return images_; }
  // Sends outgoing[k] to neighbour k and returns the messages of the neighbours in the same order;
  // see Communicator::exchange(). Takes the messages, and frees their memory. Allocates nothing
  // before the ranks agree, since others wait for messages meanwhile.
  std::vector<Bytes> exchange(std::vector<Bytes>& outgoing, std::exception_ptr failure) const {
    for (std::size_t k = 0; k < outgoing.size(); ++k)
      in_order_[order_.departure(k)].swap(outgoing[k]);
    std::vector<Bytes> arrived = comm_->exchange(order_.ranks(), in_order_, failure);
    for (Bytes& message : in_order_) message = {};
    std::vector<Bytes> incoming(arrived.size());
    for (std::size_t k = 0; k < incoming.size(); ++k) incoming[k].swap(arrived[order_.arrival(k)]);
    return incoming;
  }
  // Returns the owned nodes that `rank` has as ghosts.
  const std::vector<std::int32_t>& sent_to(int rank) const { return send_[place(rank)]; }
  // Returns the ghosts that `rank` owns. In a built plan they have the order of sent_to() there.
  const std::vector<std::int32_t>& received_from(int rank) const { return receive_[place(rank)]; }
  // Calls visit(rank) for each rank that has the owned node as a ghost.
  template <class Visit>
  void for_ranks_with(const Nodes<Dim>& nodes, std::int32_t node, const Visit& visit) const {
    const auto by_id = [&](std::int32_t a, std::int32_t b) { return nodes.id(a) < nodes.id(b); };
    for (std::size_t k = 0; k < neighbours_.size(); ++k)
      if (std::binary_search(send_[k].begin(), send_[k].end(), node, by_id)) visit(neighbours_[k]);
  }
  void send(int rank, std::int32_t node) { send_[place(rank)].push_back(node); }
  void receive(int rank, std::int32_t node) { receive_[place(rank)].push_back(node); }

  std::int64_t neighbour_count() const { return static_cast<std::int64_t>(neighbours_.size()); }
  std::int64_t nodes_sent() const {
    std::size_t nodes = 0;
    for (const std::vector<std::int32_t>& list : send_) nodes += list.size();
    return static_cast<std::int64_t>(nodes);
  }
  // Bytes of one node: its position and velocity; in space also the facet that it may have moved
  // to.
  static constexpr std::size_t kRecordSize =
      2 * Dim * sizeof(double) + (Dim == 3 ? sizeof(std::int32_t) : 0);

  // Completes the plan: sorts the lists by id, so that both sides agree.
  void build(const Nodes<Dim>& nodes) {
    exchange_.reset();
    order_messages();
    outgoing_ = {};
    incoming_ = {};
    std::vector<std::pair<std::int64_t, std::int32_t>> by_id;  // faster to sort than indices alone
    for (auto* lists : {&send_, &receive_})
      for (std::vector<std::int32_t>& list : *lists) {
        by_id.clear();
        for (const std::int32_t node : list) by_id.emplace_back(nodes.id(node), node);
        std::sort(by_id.begin(), by_id.end());
        for (std::size_t k = 0; k < list.size(); ++k) list[k] = by_id[k].second;
      }
  }
  // Allocates the buffers of update(), which then allocates no memory.
  void prepare_updates() {
    if (exchange_) return;
    make_buffers(kRecordSize, outgoing_, incoming_);
    exchange_ = comm_->persistent_exchange(order_.ranks(), outgoing_, incoming_);
  }
  bool prepared() const { return exchange_ != nullptr; }

  // Allocates the memory of permute(), so that it cannot fail.
  void reserve_order(std::int64_t count) {
    if (!neighbours_.empty()) moved_to_.resize(static_cast<std::size_t>(count));
  }
  // Updates the lists after a reordering of the nodes: the node with index from(i) has index i now.
  void permute(const View<std::int32_t>& from, std::int64_t count) {
    if (neighbours_.empty()) return;
    reserve_order(count);
    for (std::int64_t i = 0; i < count; ++i)
      moved_to_[static_cast<std::size_t>(from(i))] = static_cast<std::int32_t>(i);
    for (auto* lists : {&send_, &receive_})
      for (std::vector<std::int32_t>& list : *lists)
        for (std::int32_t& node : list) node = moved_to_[static_cast<std::size_t>(node)];
  }

  // Copies values of owned nodes to the ghosts on other ranks. Collective; if one rank throws in
  // the setup, all ranks throw. A rank that misses a message throws.
  void fill(const Communicator& comm, const View<double>& values) const {
    std::vector<Bytes> outgoing, incoming;
    std::unique_ptr<PersistentExchange> exchange;
    collective_try(comm, [&] {
      make_buffers(sizeof(double), outgoing, incoming);
      exchange = comm.persistent_exchange(order_.ranks(), outgoing, incoming);
    });
    run(*exchange, outgoing, incoming,
        [&](std::int32_t i, const auto& visit) { visit(values(i)); });
  }

  // Updates positions and velocities of ghosts. All neighbours must call it after
  // prepare_updates(). A rank that misses a message throws and keeps its ghosts unchanged.
  void update(Nodes<Dim>& nodes, const BoundarySeenFrom<Dim>& boundary_seen_from) {
    run(*exchange_, outgoing_, incoming_, [&](std::int32_t i, const auto& visit) {
      for (int d = 0; d < Dim; ++d) {
        visit(nodes.x[d](i));
        visit(nodes.v[d](i));
      }
      if constexpr (Dim == 3) visit(nodes.boundary_node(i));
    });
    if (images_.cell().any()) put_into_images(nodes, boundary_seen_from);
  }

 private:
  // Sizes one buffer for each neighbour, with `bytes_of_node` bytes for each node.
  void make_buffers(std::size_t bytes_of_node, std::vector<Bytes>& outgoing,
                    std::vector<Bytes>& incoming) const {
    outgoing.resize(neighbours_.size());
    incoming.resize(neighbours_.size());
    for (std::size_t k = 0; k < neighbours_.size(); ++k) {
      outgoing[order_.departure(k)].resize(send_[k].size() * bytes_of_node);
      incoming[order_.arrival(k)].resize(receive_[k].size() * bytes_of_node);
    }
  }

  // Allocates memory for exchange().
  void order_messages() {
    order_ = MessageOrder(neighbours_, images_);
    in_order_.resize(neighbours_.size());
    comm_->reserve_messages(neighbours_.size());
  }

  // Moves ghosts from the positions of their owners' nodes to those of the images here.
  void put_into_images(Nodes<Dim>& nodes, const BoundarySeenFrom<Dim>& boundary_seen_from) const {
    for (std::size_t k = 0; k < neighbours_.size(); ++k) {
      const Translation<Dim> to_image = images_.translation_from(neighbours_[k]);
      for (const std::int32_t i : receive_[k]) {
        nodes.set_position(i, to_image(nodes.position(i)));
        if constexpr (Dim == 3)
          nodes.boundary_node(i) =
              boundary_seen_from(to_image.image, nodes.carrier(i), nodes.boundary_node(i));
      }
    }
  }

  // Exchanges the values that for_values(node, visit) visits. Allocates no memory.
  template <class ForValues>
  void run(PersistentExchange& exchange, std::vector<Bytes>& outgoing,
           const std::vector<Bytes>& incoming, const ForValues& for_values) const {
    for (std::size_t k = 0; k < neighbours_.size(); ++k) {
      char* out = outgoing[order_.departure(k)].data();
      for (const std::int32_t i : send_[k])
        for_values(i, [&](const auto& value) { put(out, value); });
    }
    exchange.start();
    exchange.wait();
    for (std::size_t k = 0; k < neighbours_.size(); ++k) {
      const char* in = incoming[order_.arrival(k)].data();
      for (const std::int32_t i : receive_[k]) for_values(i, [&](auto& value) { take(in, value); });
    }
  }

  template <class T>
  static void put(char*& out, T value) {
    std::memcpy(out, &value, sizeof value);
    out += sizeof value;
  }
  template <class T>
  static void take(const char*& in, T& value) {
    std::memcpy(&value, in, sizeof value);
    in += sizeof value;
  }

  ImageRanks<Dim> images_;
  std::vector<int> neighbours_;  // ranks, or those of copies of the periodic cell: see ImageRanks
  RankIndices places_;
  MessageOrder order_;
  mutable std::vector<Bytes> in_order_;  // the messages of exchange() while they are sent
  std::vector<std::vector<std::int32_t>> send_, receive_;  // indices of nodes, by neighbour
  std::vector<std::int32_t> moved_to_;
  const Communicator* comm_ = nullptr;
  std::vector<Bytes> outgoing_, incoming_;
  std::unique_ptr<PersistentExchange> exchange_;  // uses the buffers, so it is declared after them
};

}  // namespace pnpbs
