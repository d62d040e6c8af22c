// SPDX-License-Identifier: BSD-3-Clause
// The ghosts of a level: which nodes of other ranks are held here, how far they reach, and whether
// they are where their owners have them.
#pragma once

#include <cstdint>
#include <vector>

#include "base/nodes.hpp"
#include "comm/communicator.hpp"
#include "comm/records.hpp"
#include "level/level_tree.hpp"
#include "level/neighbourhood.hpp"
#include "partition/halo_exchange.hpp"
#include "settings/settings.hpp"

namespace pnpbs {

template <int Dim>
class Ghosts {
 public:
  // Owned nodes go to the ranks that own their leaves by now, and ghosts are chosen anew, so many
  // hops deep. Collective; it fails on all ranks or on none.
  void exchange(const Communicator& comm, LevelTree<Dim>& tree, const Settings& settings, int hops,
                Nodes<Dim>& nodes, Neighbourhood<Dim>& neighbourhood);
  // Owned nodes go to their owners by a new partition, however far; there are no ghosts until the
  // next exchange. Collective.
  void migrate(const Communicator& comm, const LevelTree<Dim>& tree, Nodes<Dim>& nodes,
               Neighbourhood<Dim>& neighbourhood);
  // The same ghosts, exact again. All neighbours at the same time, without an agreement. Throws on
  // a rank that lacks some of them.
  void update(Nodes<Dim>& nodes);
  // Fills values at ghosts with those of their owners. Collective.
  void fill(const Communicator& comm, const View<double>& values) const {
    halo_.fill(comm, values);
  }
  // All nodes in these boxes become ghosts of ours, until the next exchange. Each is with the rank
  // that owns its place, so nobody else is asked. Collective.
  void fetch(const Communicator& comm, const LevelTree<Dim>& tree,
             const std::vector<Box<Dim>>& boxes, Nodes<Dim>& nodes, const Buckets<Dim>& buckets);

  // Sends news of these owned nodes, news_of(i), to the ranks that have them as ghosts; returns
  // what came from the others. Collective.
  template <class Record, class NewsOf>
  std::vector<Record> tell(const Communicator& comm, const Nodes<Dim>& nodes,
                           const std::vector<std::int32_t>& owned, const NewsOf& news_of) const {
    Outbox outgoing;
    for (const std::int32_t i : owned) {
      const std::vector<Record> news = news_of(i);
      halo_.for_ranks_with(nodes, i, [&](int rank) {
        for (const Record& record : news) pack(outgoing.to(rank), record);
      });
    }
    return deliver<Record>(comm, outgoing);
  }

  // The next exchange must choose them.
  void invalidate() { hops_ = 0; }
  void count_step() { ++steps_since_choice_; }
  // Allocates memory for permute(), which then cannot fail.
  void reserve_order(std::int64_t count) { halo_.reserve_order(count); }
  // The nodes were put into another order: what was at from(i) is at i now.
  void permute(const View<std::int32_t>& from, std::int64_t count) { halo_.permute(from, count); }

  // Do they reach so far, for steps until the next exchange, too?
  bool can_stay(const Settings& settings, int hops) const;
  // Do they, and are they where their owners have them?
  bool are_exact(const Nodes<Dim>& nodes, int hops) const {
    return hops_ >= hops && exact_at_ == nodes.positions();
  }

  int hops() const { return hops_; }
  std::int64_t steps_since_choice() const { return steps_since_choice_; }
  std::int64_t neighbour_ranks() const { return halo_.neighbour_count(); }
  // That this rank sends at an update.
  std::int64_t update_bytes() const {
    return halo_.nodes_sent() * static_cast<std::int64_t>(HaloExchange<Dim>::kRecordSize);
  }

 private:
  Bytes nodes_for(const Message& asked, const LevelTree<Dim>& tree, const Nodes<Dim>& nodes,
                  const Buckets<Dim>& buckets);

  HaloExchange<Dim> halo_;
  int hops_ = 0;  // they reach so far; 0: they must be chosen anew
  std::int64_t steps_since_choice_ = 0;
  std::int64_t exact_at_ = -1;  // stamp of the positions
};

}  // namespace pnpbs
