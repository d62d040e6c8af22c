// SPDX-License-Identifier: BSD-3-Clause
#include "level/ghosts.hpp"

#include <exception>
#include <map>
#include <set>
#include <unordered_set>
#include <utility>

#include "comm/records.hpp"
#include "level/reach.hpp"
#include "partition/node_exchange.hpp"
#include "partition/packed_node.hpp"

namespace pnpbs {

namespace {

template <int Dim>
BoundarySeenFrom<Dim> boundary_seen_from(const LevelTree<Dim>& tree) {
  return [&geometry = tree.geometry()](const Image<Dim>& image, Carrier carrier, std::int32_t on) {
    return geometry.boundary_seen_from(image, carrier, on);
  };
}

// Returns a node of this rank with the position and the id that it has in the periodic cell.
template <int Dim>
PackedNode<Dim> in_cell(const LevelTree<Dim>& tree, PackedNode<Dim> node) {
  const PeriodicCell<Dim>& cell = tree.geometry().cell();
  if (!cell.any()) return node;
  const std::int64_t id = node.id;
  node.translate({cell, cell.image_of(node.x)}, boundary_seen_from(tree));
  node.id = id;
  return node;
}

// A question for the nodes in a box, or a node in the answer. It has the number that stands for the
// rank that sends it where it arrives.
template <int Dim, class Content>
struct FromRank {
  int number;
  Content content;
};

}  // namespace

template <int Dim>
bool Ghosts<Dim>::can_stay(const Settings& settings, int hops) const {
  return hops_ >= hops && steps_since_choice_ + settings.exchange_interval <= ghost_life(settings);
}

template <int Dim>
void Ghosts<Dim>::update(const LevelTree<Dim>& tree, Nodes<Dim>& nodes) {
  if (exact_at_ == nodes.positions()) return;
  halo_.update(nodes, boundary_seen_from(tree));
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
    halo_.start(comm, tree.distribution().images(), neighbours);
    if (halo_.images().cell().any()) boundary_seen_from_ = boundary_seen_from(tree);
    outgoing.resize(neighbours.size());
  });
  const Halo& halo = tree.halo(hops, settings);
  const NodeExchange<Dim> travel{tree.tree(), tree.distribution(),     halo, comm.rank(),
                                 halo_,       boundary_seen_from(tree)};
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
    incoming = halo_.exchange(outgoing, failure);
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
    if (tree.distribution().owner_at(nodes.position(i)) == comm.rank())
      stay(kept++) = static_cast<std::int32_t>(i);
    else
      leaving.push_back(in_cell(tree, packed(nodes, i)));
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
  using Question = FromRank<Dim, Box<Dim>>;
  using Answer = FromRank<Dim, PackedNode<Dim>>;
  const ImageRanks<Dim>& images = tree.distribution().images();
  Outbox questions, answers;
  for (const Box<Dim>& box : boxes) {
    std::set<int> numbers;
    tree.distribution().for_owners_in(box, [&](int n) { numbers.insert(n); });
    numbers.erase(comm.rank());
    for (const int n : numbers)
      pack(questions.to(images.rank(n)),
           Question{images.seen_by(n, comm.rank()), images.translation_to(n)(box)});
  }
  std::map<int, std::vector<Box<Dim>>> asked;
  for (const Question& question : deliver<Question>(comm, questions))
    asked[question.number].push_back(question.content);
  for (const auto& [number, wanted] : asked)
    for (PackedNode<Dim>& node : nodes_for(number, wanted, tree, nodes, buckets)) {
      if (images.cell().any())
        node.translate(images.translation_to(number), boundary_seen_from(tree));
      pack(answers.to(images.rank(number)), Answer{images.seen_by(number, comm.rank()), node});
    }
  const std::vector<Answer> found = deliver<Answer>(comm, answers);
  collective_try(comm, [&] {
    for (const Answer& answer : found) {
      halo_.add_neighbour(answer.number);
      halo_.receive(answer.number, static_cast<std::int32_t>(nodes.count));
      append(nodes, answer.content, false);
    }
    halo_.build(nodes);
  });
  hops_ = hops;
}

// Returns the owned nodes in the boxes that another rank, or this one in another copy of the
// periodic cell, lacks. They are added to the halo exchange plan.
template <int Dim>
std::vector<PackedNode<Dim>> Ghosts<Dim>::nodes_for(int number, const std::vector<Box<Dim>>& boxes,
                                                    const LevelTree<Dim>& tree,
                                                    const Nodes<Dim>& nodes,
                                                    const Buckets<Dim>& buckets) {
  std::unordered_set<std::int32_t> has;
  if (halo_.knows(number)) {
    const std::vector<std::int32_t>& sent = halo_.sent_to(number);
    has.insert(sent.begin(), sent.end());
  }
  std::vector<PackedNode<Dim>> lacking;
  for (const Box<Dim>& box : boxes)
    tree.tree().for_leaves_in(box, [&](std::int32_t leaf) {
      for (std::int32_t i = buckets.begin(leaf); i < buckets.end(leaf); ++i) {
        if (!nodes.owned(i) || !has.insert(i).second) continue;
        lacking.push_back(packed(nodes, i));
        halo_.add_neighbour(number);
        halo_.send(number, i);
      }
    });
  return lacking;
}

// Both sides of the plan have the nodes in the same order, so a request is an index in it.
template <int Dim>
std::vector<GhostData> Ghosts<Dim>::receive_from_owners(
    const Communicator& comm, const std::vector<char>& wanted,
    FunctionRef<void(std::int32_t i, const Translation<Dim>& to, Bytes& bytes)> pack_data,
    std::exception_ptr failure) const {
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
    requests = halo_.exchange(requests, nullptr);
    for (std::size_t k = 0; k < neighbours.size(); ++k) {
      const std::vector<std::int32_t>& sent = halo_.sent_to(neighbours[k]);
      const Translation<Dim> to = halo_.images().translation_to(neighbours[k]);
      for_records<std::int32_t>(requests[k], [&](std::int32_t g) {
        pack_data(sent[static_cast<std::size_t>(g)], to, answers[k]);
      });
    }
  });
  collective_try(comm, [&] { answers = halo_.exchange(answers, failure); });
  for (std::size_t k = 0; k < neighbours.size(); ++k) received[k].bytes.swap(answers[k]);
  return received;
}

template class Ghosts<2>;
template class Ghosts<3>;

}  // namespace pnpbs
