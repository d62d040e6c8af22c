// SPDX-License-Identifier: BSD-3-Clause
// The adjacency lists (section 2.3 of the paper). The list of a node has all other nodes within
// radius * (d_i + d_j) / 2, sorted by id, so that sums over it do not depend on ranks, threads or
// the order in memory. The layout suits SIMD: nodes form blocks of kLanes, and the k-th neighbours
// of a block are stored side by side. Shorter lists are padded with a far-away node, whose force is
// exactly 0.
#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "base/chunked_rows.hpp"
#include "base/nodes.hpp"
#include "neighbors/buckets.hpp"
#include "neighbors/candidates.hpp"

namespace pnpbs {

// Number of nodes in a block, which are processed side by side.
inline constexpr int kLanes = 8;

// The lists of the nodes of a block.
struct ListBlock {
  const std::int32_t* entries;  // [length][kLanes]
  std::int32_t length;
};

// Selects the nodes that get lists. With owned_nodes, the lists of ghosts are empty.
enum class ListsOf { all_nodes, owned_nodes };

// The adjacency lists of all nodes of a rank.
template <int Dim>
class AdjacencyList {
 public:
  // Lists all pairs within the radius that are visible from each other. Nodes must be sorted by
  // bucket. visibility.may_occlude(i) returns true if anything near node i may hide other nodes
  // from it. visibility.visible(i, j) must be symmetric; it is called only for pairs within the
  // radius of which at least one node may_occlude. Both are called from several threads.
  template <class Visibility>
  void build(const Nodes<Dim>& nodes, const Buckets<Dim>& buckets, double radius,
             Visibility&& visibility, ListsOf listed = ListsOf::all_nodes);

  // Adds the lists of the nodes `more` to lists of owned nodes. Nodes, buckets and visibility must
  // not have changed since build().
  template <class Visibility>
  void add(const Nodes<Dim>& nodes, const Buckets<Dim>& buckets, Visibility&& visibility,
           const std::vector<std::int32_t>& more);

  double radius() const { return radius_; }
  // Returns true if the list of node i has been built. Otherwise it is empty.
  bool has(std::int64_t i) const { return has_.empty() || has_[static_cast<std::size_t>(i)] != 0; }
  std::int64_t block_count() const { return (count_ + kLanes - 1) / kLanes; }

  ListBlock block(std::int64_t b) const {
    const std::span<const std::int32_t> entries = blocks_.row(b);
    return {entries.data(), static_cast<std::int32_t>(entries.size()) / kLanes};
  }

  // Calls visit(j) for the neighbours of node i, by increasing id.
  template <class Visit>
  void for_neighbours(std::int64_t i, const Visit& visit) const {
    const ListBlock list = block(i / kLanes);
    for (std::int32_t k = 0; k < list.length; ++k) {
      const std::int32_t j = list.entries[k * kLanes + i % kLanes];
      if (j == count_) return;
      visit(static_cast<std::int64_t>(j));
    }
  }

 private:
  // Writes the lists of the nodes of a block. Each thread has one and reuses the candidates of the
  // last bucket.
  template <class Visibility>
  struct BlockWriter {
    const Nodes<Dim>& nodes;
    const Buckets<Dim>& buckets;
    double radius;
    Visibility& visibility;
    const AdjacencyList& lists;
    Candidates<Dim> candidates{};

    void operator()(std::int64_t block, std::vector<std::int32_t>& out);
    void look_at_bucket(std::int32_t bucket);
    std::int32_t find_neighbours(std::int64_t i);
  };

  template <class Visibility>
  auto writer_maker(const Nodes<Dim>& nodes, const Buckets<Dim>& buckets,
                    Visibility& visibility) const {
    return [&] {
      return BlockWriter<std::remove_reference_t<Visibility>>{nodes, buckets, radius_, visibility,
                                                              *this};
    };
  }

  std::int64_t count_ = 0;
  double radius_ = 0;
  std::vector<char> has_;  // by node: its list is built; empty if all are
  ChunkedRows<std::int32_t, 64> blocks_;
};

template <int Dim>
template <class Visibility>
void AdjacencyList<Dim>::BlockWriter<Visibility>::look_at_bucket(std::int32_t bucket) {
  candidates.gather(nodes, buckets, radius, bucket);
  candidates.keep_pairs([&](std::int64_t i) { return visibility.may_occlude(i); },
                        [&](std::int64_t i, std::int64_t j) { return visibility.visible(i, j); });
}

template <int Dim>
template <class Visibility>
std::int32_t AdjacencyList<Dim>::BlockWriter<Visibility>::find_neighbours(std::int64_t i) {
  if (buckets.bucket_of(i) != candidates.bucket()) look_at_bucket(buckets.bucket_of(i));
  return candidates.neighbour_count(i);
}

template <int Dim>
template <class Visibility>
void AdjacencyList<Dim>::BlockWriter<Visibility>::operator()(std::int64_t block,
                                                             std::vector<std::int32_t>& out) {
  const std::int32_t pad = static_cast<std::int32_t>(nodes.count);
  const std::size_t first = out.size();
  const auto end_of = [&](std::int32_t rows) {
    return first + static_cast<std::size_t>(rows) * kLanes;
  };
  std::int32_t length = 0;
  for (std::int64_t i = block * kLanes; i < std::min((block + 1) * kLanes, nodes.count); ++i) {
    if (!lists.has(i)) continue;
    const std::int32_t found = find_neighbours(i);
    if (found == 0) continue;
    if (found > length) {
      length = found;
      if (end_of(length) > out.size()) out.resize(end_of(length + 2), pad);
    }
    std::int32_t* at = out.data() + first + i % kLanes;
    candidates.for_neighbours(i, [&](std::int32_t j) {
      *at = j;
      at += kLanes;
    });
  }
  out.resize(end_of(length));
}

template <int Dim>
template <class Visibility>
void AdjacencyList<Dim>::build(const Nodes<Dim>& nodes, const Buckets<Dim>& buckets, double radius,
                               Visibility&& visibility, ListsOf listed) {
  count_ = nodes.count;
  radius_ = radius;
  has_.clear();
  if (listed == ListsOf::owned_nodes)
    has_.assign(nodes.owned.data(), nodes.owned.data() + nodes.count);
  blocks_.build("pnpbs::AdjacencyList::build", block_count(),
                writer_maker(nodes, buckets, visibility));
}

template <int Dim>
template <class Visibility>
void AdjacencyList<Dim>::add(const Nodes<Dim>& nodes, const Buckets<Dim>& buckets,
                             Visibility&& visibility, const std::vector<std::int32_t>& more) {
  std::vector<char> again(static_cast<std::size_t>(block_count()), 0);
  for (const std::int32_t i : more) {
    if (has(i)) continue;
    has_[static_cast<std::size_t>(i)] = 1;
    again[static_cast<std::size_t>(i / kLanes)] = 1;
  }
  blocks_.rewrite(
      "pnpbs::AdjacencyList::add", block_count(),
      [&](std::int64_t b) { return again[static_cast<std::size_t>(b)] != 0; },
      writer_maker(nodes, buckets, visibility));
}

}  // namespace pnpbs
