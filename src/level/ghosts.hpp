// SPDX-License-Identifier: BSD-3-Clause
// The ghosts of a level: which nodes of other ranks this rank has, how far they reach, and whether
// their positions are exact.
#pragma once

#include <cstdint>
#include <exception>
#include <vector>

#include "base/function_ref.hpp"
#include "base/nodes.hpp"
#include "comm/communicator.hpp"
#include "comm/records.hpp"
#include "level/level_tree.hpp"
#include "level/neighbourhood.hpp"
#include "partition/halo_exchange.hpp"
#include "partition/packed_node.hpp"
#include "settings/settings.hpp"

namespace pnpbs {

// Data of ghosts, from the rank that owns them.
struct GhostData {
  std::vector<std::int32_t> ghosts;
  Bytes bytes;  // what the owner has packed for each of them, in this order
};

// The halo exchange of a level, and the state of its ghosts.
template <int Dim>
class Ghosts {
 public:
  // Migrates owned nodes to the ranks that own their leaves, and selects the ghosts again, to a
  // depth of `hops`. All ranks must call it, and if one rank throws, all ranks throw.
  void exchange(const Communicator& comm, LevelTree<Dim>& tree, const Settings& settings, int hops,
                Nodes<Dim>& nodes, Neighbourhood<Dim>& neighbourhood);
  // Migrates owned nodes to their owners in a new partition, over any distance. There are no ghosts
  // until the next exchange. All ranks must call it, and if one rank throws, all ranks throw.
  void migrate(const Communicator& comm, const LevelTree<Dim>& tree, Nodes<Dim>& nodes,
               Neighbourhood<Dim>& neighbourhood);
  // Allocates memory for update(), once for an exchange. Most exchanges of the finish have no
  // updates. All ranks must call it, and if one rank throws, all ranks throw.
  void prepare_updates(const Communicator& comm) {
    collective_try(comm, [&] { halo_.prepare_updates(); });
  }
  bool prepared() const { return halo_.prepared(); }
  // Sends positions and velocities of the present ghosts, which are exact afterwards. All
  // neighbours must call it at the same time after prepare_updates(), without an agreement. Throws
  // only on a rank that lacks values.
  void update(const LevelTree<Dim>& tree, Nodes<Dim>& nodes);
  // Fills the values at ghosts with those of their owners. All ranks must call it.
  void fill(const Communicator& comm, const View<double>& values) const {
    halo_.fill(comm, values);
  }
  // Makes all nodes in these boxes ghosts of this rank until the next exchange. Every node must be
  // on the rank that owns its position, because only the owners of the boxes send nodes. All ranks
  // must call it, and if one rank throws, all ranks throw.
  void fetch(const Communicator& comm, const LevelTree<Dim>& tree,
             const std::vector<Box<Dim>>& boxes, Nodes<Dim>& nodes, const Buckets<Dim>& buckets);

  // Sends the records news_of(i) of these owned nodes to the ranks that have them as ghosts. A
  // record has a function translate(to, boundary_seen_from) for its positions, ids and facets in a
  // periodic domain.
  // Returns the records from other ranks. All ranks must call it, and if one rank throws, all ranks
  // throw.
  template <class Record, class NewsOf>
  std::vector<Record> tell(const Communicator& comm, const Nodes<Dim>& nodes,
                           const std::vector<std::int32_t>& owned, const NewsOf& news_of) const {
    Outbox outgoing;
    for (const std::int32_t i : owned) {
      const std::vector<Record> news = news_of(i);
      halo_.for_ranks_with(nodes, i, [&](int number) {
        const Translation<Dim> to = halo_.images().translation_to(number);
        for (Record record : news) {
          if (to.cell.any()) record.translate(to, boundary_seen_from_);
          pack(outgoing.to(halo_.images().rank(number)), record);
        }
      });
    }
    return deliver<Record>(comm, outgoing);
  }

  // Receives data of the ghosts for which `wanted` is set from their owners, which call
  // pack_data(i, to, bytes) for these nodes, with positions and ids translated by `to`. `failure`
  // is the failure of this rank's preceding work, or null. All ranks must call it, and if one rank
  // throws, all ranks throw.
  std::vector<GhostData> receive_from_owners(
      const Communicator& comm, const std::vector<char>& wanted,
      FunctionRef<void(std::int32_t i, const Translation<Dim>& to, Bytes& bytes)> pack_data,
      std::exception_ptr failure) const;

  // Requires the next exchange to select the ghosts again.
  void invalidate() { hops_ = 0; }
  void count_step() { ++steps_since_choice_; }
  // Allocates memory for permute(), which then cannot fail.
  void reserve_order(std::int64_t count) { halo_.reserve_order(count); }
  // Adapts to a new order of the nodes: the node with index from(i) gets index i.
  void permute(const View<std::int32_t>& from, std::int64_t count) { halo_.permute(from, count); }

  // Returns whether the ghosts reach `hops` hops and suffice for the steps until the next exchange.
  bool can_stay(const Settings& settings, int hops) const;
  // Returns whether the ghosts reach `hops` hops and have the positions of their owners.
  bool are_exact(const Nodes<Dim>& nodes, int hops) const {
    return hops_ >= hops && exact_at_ == nodes.positions();
  }

  int hops() const { return hops_; }
  std::int64_t steps_since_choice() const { return steps_since_choice_; }
  std::int64_t neighbour_ranks() const { return halo_.neighbour_count(); }
  // Returns the bytes that this rank sends in an update.
  std::int64_t update_bytes() const {
    return halo_.nodes_sent() * static_cast<std::int64_t>(HaloExchange<Dim>::kRecordSize);
  }

 private:
  std::vector<PackedNode<Dim>> nodes_for(int number, const std::vector<Box<Dim>>& boxes,
                                         const LevelTree<Dim>& tree, const Nodes<Dim>& nodes,
                                         const Buckets<Dim>& buckets);

  HaloExchange<Dim> halo_;
  BoundarySeenFrom<Dim> boundary_seen_from_;  // in a periodic domain
  int hops_ = 0;                              // depth of the ghosts; 0: they must be selected again
  std::int64_t steps_since_choice_ = 0;
  std::int64_t exact_at_ = -1;  // stamp of the positions for which ghosts are exact
};

}  // namespace pnpbs
