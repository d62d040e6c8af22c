// SPDX-License-Identifier: BSD-3-Clause
// The stars of a level, and the ghosts that they need. The hops of an exchange bring what lies
// within a few spacings; where d jumps, or the nodes are far too few for d, the circle of a
// triangle may reach farther. Then the other ranks are asked for what lies there.
#include <algorithm>
#include <map>
#include <unordered_set>

#include "comm/records.hpp"
#include "level/level.hpp"
#include "partition/packed_node.hpp"

namespace pnpbs {

namespace {

void widen(Box<2>& box, const Box<2>& by) {
  for (int k = 0; k < 2; ++k) {
    box.low[k] = std::min(box.low[k], by.low[k]);
    box.high[k] = std::max(box.high[k], by.high[k]);
  }
}

}  // namespace

void Level::renew_stars() {
  const PhaseTimer timer(timers_, Phase::stars);
  stars_.build({nodes_, map_, sectors_, buckets_, lists_, near_edges_, known_});
}

void Level::prepare_lists() {
  if (!ghosts_exact_ || ghost_hops_ < kStarHops) exchange_for_stars();
  if (distributed())
    make_lists_and_stars(kStarHops, settings_.adjacency_radius, 0);
  else
    rebuild_lists(settings_.adjacency_radius);
}

// Lists and stars right after an exchange that deep: those of the owned nodes and of the ghosts
// around them are right, up to so many neighbours away.
void Level::make_lists_and_stars(int hops, double radius, int rings) {
  agreed(*comm_, [&] { rebuild_lists(radius); });
  make_stars(hops, radius, rings);
}

// The same where the lists are there.
void Level::make_stars(int hops, double radius, int rings) {
  known_ = known_after_exchange(hops);
  while (true) {
    std::vector<Box<2>> unknown;
    agreed(*comm_, [&] {
      renew_stars();
      unknown = unknown_around_stars(rings);
    });
    if (comm_->allreduce_sum(unknown.size()) == 0) break;
    fetch_nodes_in(unknown);
    agreed(*comm_, [&] { rebuild_lists(radius); });
  }
  known_ = KnownRegion<2>();
}

KnownRegion<2> Level::known_after_exchange(int hops) {
  if (!distributed()) return {};
  const Halo& halo = halo_of(hops);
  std::vector<char> known(static_cast<std::size_t>(map_.tree().leaf_count()), 0);
  for (std::int32_t leaf = 0; leaf < map_.tree().leaf_count(); ++leaf) {
    known[static_cast<std::size_t>(leaf)] = distribution_.owns(leaf) || map_.leaf_outside(leaf);
    if (distribution_.refined(leaf))
      halo.for_ranks(leaf, [&](int r) {
        if (r == comm_->rank()) known[static_cast<std::size_t>(leaf)] = 1;
      });
  }
  return KnownRegion<2>(map_.tree(), known);
}

// Those not reached yet.
std::vector<std::int64_t> Level::neighbours_of(const std::vector<std::int64_t>& front,
                                               std::vector<char>& reached) const {
  std::vector<std::int64_t> next;
  for (const std::int64_t i : front)
    stars_.for_neighbours(i, [&](std::int64_t j, bool) {
      char& known = reached[static_cast<std::size_t>(j)];
      if (!known) next.push_back(j);
      known = 1;
    });
  return next;
}

// What must be known for the stars that are needed: one box for the nodes of each leaf.
std::vector<Box<2>> Level::unknown_around_stars(int rings) const {
  if (known_.is_everywhere()) return {};
  std::map<std::int32_t, Box<2>> box_of;
  const auto ask_around = [&](std::int64_t i) {
    if (stars_.needs(i) == 0) return;
    const Box<2> box = box_around<2>(nodes_.position(i), stars_.needs(i));
    widen(box_of.try_emplace(buckets_.bucket_of(i), box).first->second, box);
  };
  std::vector<std::int64_t> front;
  std::vector<char> reached(static_cast<std::size_t>(nodes_.count), 0);
  for (std::int64_t i = 0; i < nodes_.count; ++i) {
    reached[static_cast<std::size_t>(i)] = nodes_.owned(i);
    if (!nodes_.owned(i)) continue;
    ask_around(i);
    bool at_rim = false;
    stars_.for_neighbours(i, [&](std::int64_t j, bool) { at_rim = at_rim || !nodes_.owned(j); });
    if (at_rim) front.push_back(i);
  }
  for (int ring = 0; ring < rings; ++ring) {
    front = neighbours_of(front, reached);
    for (const std::int64_t i : front) ask_around(i);
  }
  std::vector<Box<2>> boxes;
  for (const auto& [leaf, box] : box_of) boxes.push_back(box);
  return boxes;
}

// All nodes in these boxes become ghosts of ours, until the next exchange.
void Level::fetch_nodes_in(const std::vector<Box<2>>& boxes) {
  ++version_;
  const PhaseTimer timer(timers_, Phase::exchange);
  Bytes question;
  for (const Box<2>& box : boxes) pack(question, box);
  std::vector<Message> asked, answers;
  for (int r = 0; r < comm_->size(); ++r)
    if (r != comm_->rank() && !question.empty()) asked.push_back({r, question});
  for (const Message& theirs : comm_->sparse_all_to_all(asked)) {
    Bytes answer = nodes_for(theirs);
    if (!answer.empty()) answers.push_back({theirs.rank, std::move(answer)});
  }
  const std::vector<Message> found = comm_->sparse_all_to_all(answers);
  agreed(*comm_, [&] {
    for (const Message& theirs : found) {
      plan_.add_neighbour(theirs.rank);
      for_records<PackedNode<2>>({theirs.bytes}, [&](const PackedNode<2>& node) {
        plan_.receive(theirs.rank, static_cast<std::int32_t>(nodes_.count));
        append(nodes_, node, false);
      });
    }
    plan_.build(nodes_);
  });
  for (const Box<2>& box : boxes) known_.add(box);
  lists_valid_ = false;
}

// Our nodes in the boxes that a rank asks about, if it does not have them yet; from now on it has.
Bytes Level::nodes_for(const Message& asked) {
  std::unordered_set<std::int32_t> has;
  if (plan_.knows(asked.rank)) {
    const std::vector<std::int32_t>& sent = plan_.sent_to(asked.rank);
    has.insert(sent.begin(), sent.end());
  }
  Bytes answer;
  for_records<Box<2>>({asked.bytes}, [&](const Box<2>& box) {
    map_.tree().for_leaves_in(box, [&](std::int32_t leaf) {
      for (std::int32_t i = buckets_.begin(leaf); i < buckets_.end(leaf); ++i) {
        if (!nodes_.owned(i) || !has.insert(i).second) continue;
        pack(answer, packed(nodes_, i));
        plan_.add_neighbour(asked.rank);
        plan_.send(asked.rank, i);
      }
    });
  });
  return answer;
}

}  // namespace pnpbs
