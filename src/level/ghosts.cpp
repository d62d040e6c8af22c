// SPDX-License-Identifier: BSD-3-Clause
#include "level/ghosts.hpp"

#include <exception>
#include <set>
#include <unordered_set>
#include <utility>

#include "comm/records.hpp"
#include "level/reach.hpp"
#include "partition/node_exchange.hpp"
#include "partition/packed_node.hpp"

namespace pnpbs {

template <int Dim>
bool Ghosts<Dim>::can_stay(const Settings& settings, int hops) const {
  return hops_ >= hops && steps_since_choice_ + settings.exchange_interval <= ghost_life(settings);
}

template <int Dim>
void Ghosts<Dim>::update(Nodes<Dim>& nodes) {
  if (exact_at_ == nodes.positions()) return;
  halo_.update(nodes);
  nodes.moved();
  exact_at_ = nodes.positions();
}

template <int Dim>
void Ghosts<Dim>::exchange(const Communicator& comm, LevelTree<Dim>& tree, const Settings& settings,
                           int hops, Nodes<Dim>& nodes, Neighbourhood<Dim>& neighbourhood) {
  hops_ = 0;
  std::vector<Bytes> outgoing;
  collective_try(comm, [&] {
    const std::vector<int>& neighbours = tree.halo(hops, settings).neighbours();
    halo_.start(comm, neighbours);
    outgoing.resize(neighbours.size());
  });
  const Halo& halo = tree.halo(hops, settings);
  const NodeExchange<Dim> travel{tree.tree(), tree.distribution(), halo, comm.rank(), halo_};
  View<std::int32_t> stay;
  std::int64_t kept = 0;
  const std::exception_ptr failure = failure_of([&] {
    const Buckets<Dim>& buckets = neighbourhood.buckets();
    const auto known_leaf = [&](std::int64_t i) {
      return buckets.knows(i) ? buckets.bucket_of(i) : -1;
    };
    stay = nodes.order_scratch();
    kept = travel.pack_leaving(nodes, known_leaf, outgoing, stay);
  });
  std::vector<Bytes> incoming;
  collective_try(comm, [&] {
    incoming = comm.exchange(halo.neighbours(), outgoing, failure);
    outgoing = {};  // Frees its memory before the nodes take more.
    travel.reserve(nodes, kept, incoming);
  });
  // From here on no rank can fail, so no node is lost.
  collective_try(comm, [&] {
    neighbourhood.keep_nodes(nodes, stay, kept);
    travel.append_arriving(nodes, std::move(incoming));
  });
  hops_ = hops;
  exact_at_ = nodes.positions();
  steps_since_choice_ = 0;
}

template <int Dim>
void Ghosts<Dim>::migrate(const Communicator& comm, const LevelTree<Dim>& tree, Nodes<Dim>& nodes,
                          Neighbourhood<Dim>& neighbourhood) {
  std::vector<PackedNode<Dim>> leaving;
  View<std::int32_t>& stay = nodes.order_scratch();
  std::int64_t kept = 0;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    if (!nodes.owned(i)) continue;
    if (tree.owner_at(nodes.position(i)) == comm.rank())
      stay(kept++) = static_cast<std::int32_t>(i);
    else
      leaving.push_back(packed(nodes, i));
  }
  const std::vector<PackedNode<Dim>> arriving = redistribute(
      comm, leaving, [&](const PackedNode<Dim>& node) { return tree.owner_at(node.x); });
  collective_try(
      comm, [&] { nodes.reserve_with_room(kept + static_cast<std::int64_t>(arriving.size())); });
  neighbourhood.keep_nodes(nodes, stay, kept);
  for (const PackedNode<Dim>& node : arriving) append(nodes, node, true);
  hops_ = 0;
}

template <int Dim>
void Ghosts<Dim>::fetch(const Communicator& comm, const LevelTree<Dim>& tree,
                        const std::vector<Box<Dim>>& boxes, Nodes<Dim>& nodes,
                        const Buckets<Dim>& buckets) {
  const int hops = std::exchange(hops_, 0);  // restored on success
  Outbox questions;
  for (const Box<Dim>& box : boxes) {
    std::set<int> ranks;
    tree.distribution().for_owners_in(box, [&](int r) { ranks.insert(r); });
    ranks.erase(comm.rank());
    for (const int r : ranks) pack(questions.to(r), box);
  }
  std::vector<Message> answers;
  for (const Message& theirs : comm.sparse_all_to_all(questions.messages())) {
    Bytes answer = nodes_for(theirs, tree, nodes, buckets);
    if (!answer.empty()) answers.push_back({theirs.rank, std::move(answer)});
  }
  const std::vector<Message> found = comm.sparse_all_to_all(answers);
  collective_try(comm, [&] {
    for (const Message& theirs : found) {
      halo_.add_neighbour(theirs.rank);
      for_records<PackedNode<Dim>>({theirs.bytes}, [&](const PackedNode<Dim>& node) {
        halo_.receive(theirs.rank, static_cast<std::int32_t>(nodes.count));
        append(nodes, node, false);
      });
    }
    halo_.build(nodes);
  });
  hops_ = hops;
}

// Returns the owned nodes in the boxes of the message that its sender lacks. They are added to the
// halo exchange plan.
template <int Dim>
Bytes Ghosts<Dim>::nodes_for(const Message& asked, const LevelTree<Dim>& tree,
                             const Nodes<Dim>& nodes, const Buckets<Dim>& buckets) {
  std::unordered_set<std::int32_t> has;
  if (halo_.knows(asked.rank)) {
    const std::vector<std::int32_t>& sent = halo_.sent_to(asked.rank);
    has.insert(sent.begin(), sent.end());
  }
  Bytes answer;
  for_records<Box<Dim>>({asked.bytes}, [&](const Box<Dim>& box) {
    tree.tree().for_leaves_in(box, [&](std::int32_t leaf) {
      for (std::int32_t i = buckets.begin(leaf); i < buckets.end(leaf); ++i) {
        if (!nodes.owned(i) || !has.insert(i).second) continue;
        pack(answer, packed(nodes, i));
        halo_.add_neighbour(asked.rank);
        halo_.send(asked.rank, i);
      }
    });
  });
  return answer;
}

// Both sides of the plan have the nodes in the same order, so a request is an index in it.
template <int Dim>
std::vector<GhostData> Ghosts<Dim>::receive_from_owners(
    const Communicator& comm, const std::vector<char>& wanted,
    FunctionRef<void(std::int32_t i, Bytes& bytes)> pack_data, std::exception_ptr failure) const {
  const std::vector<int>& neighbours = halo_.neighbours();
  std::vector<GhostData> received;
  std::vector<Bytes> requests, answers;
  attempt(failure, [&] {
    received.resize(neighbours.size());
    requests.resize(neighbours.size());
    answers.resize(neighbours.size());
    for (std::size_t k = 0; k < neighbours.size(); ++k) {
      const std::vector<std::int32_t>& ghosts = halo_.received_from(neighbours[k]);
      for (std::size_t g = 0; g < ghosts.size(); ++g) {
        if (!wanted[static_cast<std::size_t>(ghosts[g])]) continue;
        received[k].ghosts.push_back(ghosts[g]);
        pack(requests[k], static_cast<std::int32_t>(g));
      }
    }
  });
  agree_on_failure(comm, failure);
  failure = failure_of([&] {
    requests = comm.exchange(neighbours, requests, nullptr);
    for (std::size_t k = 0; k < neighbours.size(); ++k) {
      const std::vector<std::int32_t>& sent = halo_.sent_to(neighbours[k]);
      for_records<std::int32_t>({requests[k]}, [&](std::int32_t g) {
        pack_data(sent[static_cast<std::size_t>(g)], answers[k]);
      });
    }
  });
  collective_try(comm, [&] { answers = comm.exchange(neighbours, answers, failure); });
  for (std::size_t k = 0; k < neighbours.size(); ++k) received[k].bytes.swap(answers[k]);
  return received;
}

template class Ghosts<2>;
template class Ghosts<3>;

}  // namespace pnpbs
