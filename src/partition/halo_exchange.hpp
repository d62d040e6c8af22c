// SPDX-License-Identifier: BSD-3-Clause
// Which owned nodes other ranks have as ghosts, and where our ghosts come from: as long as nobody
// changes its mind about that, positions and velocities of ghosts are renewed by one message to and
// from each neighbour, in buffers that stay.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "base/nodes.hpp"
#include "comm/communicator.hpp"
#include "comm/rank_places.hpp"

namespace pnpbs {

template <int Dim>
class HaloExchange {
 public:
  void start(const std::vector<int>& neighbours) {
    neighbours_ = neighbours;
    places_ = {};
    for (const int rank : neighbours) places_.add(rank);
    send_.assign(neighbours.size(), {});
    receive_.assign(neighbours.size(), {});
    outgoing_.resize(neighbours.size());
    incoming_.resize(neighbours.size());
  }
  // Both sides of a pair of ranks must do so.
  void add_neighbour(int rank) {
    if (knows(rank)) return;
    places_.add(rank);
    neighbours_.push_back(rank);
    send_.emplace_back();
    receive_.emplace_back();
    outgoing_.emplace_back();
    incoming_.emplace_back();
  }
  bool knows(int rank) const { return places_.of(rank) >= 0; }
  std::size_t place(int rank) const { return static_cast<std::size_t>(places_.of(rank)); }
  // Owned nodes that the rank has as ghosts.
  const std::vector<std::int32_t>& sent_to(int rank) const { return send_[place(rank)]; }
  // Calls visit(rank) for the ranks that have that owned node as a ghost.
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
  // Of a node's position and velocity; in space also of the facet that it may have moved to.
  static constexpr std::size_t kRecordSize =
      2 * Dim * sizeof(double) + (Dim == 3 ? sizeof(std::int32_t) : 0);

  // Both sides put their lists into the order of ids, so that they match, and make the buffers.
  void build(const Nodes<Dim>& nodes) {
    for (auto* lists : {&send_, &receive_})
      for (std::vector<std::int32_t>& list : *lists)
        std::sort(list.begin(), list.end(),
                  [&](std::int32_t a, std::int32_t b) { return nodes.id(a) < nodes.id(b); });
    for (std::size_t k = 0; k < neighbours_.size(); ++k) {
      outgoing_[k].resize(send_[k].size() * kRecordSize);
      incoming_[k].resize(receive_[k].size() * kRecordSize);
    }
  }

  // The nodes were put into another order: what was at from(i) is at i now.
  void permute(const View<std::int32_t>& from, std::int64_t count) {
    if (neighbours_.empty()) return;
    moved_to_.resize(static_cast<std::size_t>(count));
    for (std::int64_t i = 0; i < count; ++i)
      moved_to_[static_cast<std::size_t>(from(i))] = static_cast<std::int32_t>(i);
    for (auto* lists : {&send_, &receive_})
      for (std::vector<std::int32_t>& list : *lists)
        for (std::int32_t& node : list) node = moved_to_[static_cast<std::size_t>(node)];
  }

  // Owners send values; these buffers must not be those of another exchange. All neighbours at the
  // same time, after each has made its buffers.
  void make_buffers(std::vector<Bytes>& outgoing, std::vector<Bytes>& incoming) const {
    for (const std::vector<std::int32_t>& list : send_)
      outgoing.emplace_back(list.size() * sizeof(double));
    for (const std::vector<std::int32_t>& list : receive_)
      incoming.emplace_back(list.size() * sizeof(double));
  }
  void update(const Communicator& comm, const View<double>& values, std::vector<Bytes>& outgoing,
              std::vector<Bytes>& incoming) const {
    for (std::size_t k = 0; k < neighbours_.size(); ++k) {
      char* out = outgoing[k].data();
      for (const std::int32_t i : send_[k]) put(out, values(i));
    }
    comm.exchange_known(neighbours_, outgoing, incoming);
    for (std::size_t k = 0; k < neighbours_.size(); ++k) {
      const char* in = incoming[k].data();
      for (const std::int32_t i : receive_[k]) take(in, values(i));
    }
  }

  // Owners send positions and velocities. All neighbours at the same time.
  void update(const Communicator& comm, Nodes<Dim>& nodes) {
    for (std::size_t k = 0; k < neighbours_.size(); ++k) {
      char* out = outgoing_[k].data();
      for (std::int32_t i : send_[k]) {
        for (int d = 0; d < Dim; ++d) {
          put(out, nodes.x[d](i));
          put(out, nodes.v[d](i));
        }
        if constexpr (Dim == 3) put(out, nodes.boundary_node(i));
      }
    }
    comm.exchange_known(neighbours_, outgoing_, incoming_);
    for (std::size_t k = 0; k < neighbours_.size(); ++k) {
      const char* in = incoming_[k].data();
      for (std::int32_t i : receive_[k]) {
        for (int d = 0; d < Dim; ++d) {
          take(in, nodes.x[d](i));
          take(in, nodes.v[d](i));
        }
        if constexpr (Dim == 3) take(in, nodes.boundary_node(i));
      }
    }
  }

 private:
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

  std::vector<int> neighbours_;
  RankPlaces places_;
  std::vector<std::vector<std::int32_t>> send_, receive_;  // places in memory
  std::vector<Bytes> outgoing_, incoming_;
  std::vector<std::int32_t> moved_to_;
};

}  // namespace pnpbs
