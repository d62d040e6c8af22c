// SPDX-License-Identifier: BSD-3-Clause
// The adjacency list (section 2.3 of the paper): for every node all others within
// radius * (d_i + d_j) / 2, in the order of their ids, so that sums over it do not depend on ranks,
// threads or the order in memory. Laid out for SIMD: blocks of kLanes nodes, the k-th neighbours
// of a block side by side; shorter lists are padded with a far-away node, whose force is exactly 0.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "core/chunked_rows.hpp"
#include "core/nodes.hpp"
#include "neighbors/buckets.hpp"

namespace pnpbs {

inline constexpr int kLanes = 8;

struct ListBlock {
  const std::int32_t* entries;  // [length][kLanes]
  std::int32_t length;
};

template <int Dim>
class AdjacencyList {
 public:
  // Lists the pairs for which visible(i, j) holds; nodes must be sorted by bucket.
  // Visible must be symmetric and is asked for pairs within the radius only.
  template <class Visible>
  void build(const Nodes<Dim>& nodes, const Buckets<Dim>& buckets, double radius,
             const Visible& visible);

  double radius() const { return radius_; }
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
  // Nodes near one bucket, copied together so that the distance tests run over plain arrays.
  struct Candidates {
    std::int32_t bucket = -1;
    std::array<std::vector<double>, Dim> x;
    std::vector<double> d;
    std::vector<std::uint8_t> is_near;
    std::vector<std::int32_t> node;  // and eight more, so that whole groups can be read
    std::int32_t count = 0;
    std::int32_t first_own = 0;  // place of the bucket's own first node

    void gather(const Nodes<Dim>& nodes, const Buckets<Dim>& buckets, std::int32_t of_bucket);
    // Fills hits with the nodes within radius of node i, itself left out; returns how many.
    // `first` is the first node of the bucket, in which i lies.
    std::int32_t find(const Nodes<Dim>& nodes, std::int64_t i, std::int64_t first, double radius,
                      std::vector<std::int32_t>& hits);
  };

  static void sort_by_id(const Nodes<Dim>& nodes, std::int32_t* first, std::int32_t* last);
  // Writes the lists of the nodes of one block after the other.
  template <class Visible>
  struct BlockWriter {
    const Nodes<Dim>& nodes;
    const Buckets<Dim>& buckets;
    double radius;
    const Visible& visible;
    Candidates candidates{};
    std::vector<std::int32_t> hits{}, all{};

    void operator()(std::int64_t block, std::vector<std::int32_t>& out);
    void list(std::int64_t i);
  };

  std::int64_t count_ = 0;
  double radius_ = 0;
  ChunkedRows<std::int32_t, 64> blocks_;
};

template <int Dim>
void AdjacencyList<Dim>::Candidates::gather(const Nodes<Dim>& nodes, const Buckets<Dim>& buckets,
                                            std::int32_t of_bucket) {
  bucket = of_bucket;
  node.clear();
  first_own = 0;
  buckets.for_neighbours(bucket, [&](std::int32_t other) {
    if (other == bucket) first_own = static_cast<std::int32_t>(node.size());
    for (std::int32_t j = buckets.begin(other); j < buckets.end(other); ++j) node.push_back(j);
  });
  const std::size_t n = node.size();
  count = static_cast<std::int32_t>(n);
  for (int k = 0; k < Dim; ++k) x[k].resize(n);
  d.resize(n);
  is_near.assign(n + 8, 0);  // no hits beyond the last
  node.resize(n + 8, 0);
  for (std::size_t c = 0; c < n; ++c) {
    for (int k = 0; k < Dim; ++k) x[k][c] = nodes.x[k](node[c]);
    d[c] = nodes.d(node[c]);
  }
}

template <int Dim>
std::int32_t AdjacencyList<Dim>::Candidates::find(const Nodes<Dim>& nodes, std::int64_t i,
                                                  std::int64_t first, double radius,
                                                  std::vector<std::int32_t>& hits) {
  const std::int32_t n = count;
  if (hits.size() < node.size()) hits.resize(node.size());
  const Point<Dim> own = nodes.position(i);
  const double d_own = nodes.d(i), half = 0.5 * radius;
  std::uint8_t* const near = is_near.data();
  const double* const ds = d.data();
  std::array<const double*, Dim> xs;
  for (int k = 0; k < Dim; ++k) xs[k] = x[k].data();
#pragma omp simd
  for (std::int32_t c = 0; c < n; ++c) {
    double square = 0;
    for (int k = 0; k < Dim; ++k) square += (xs[k][c] - own[k]) * (xs[k][c] - own[k]);
    const double reach = half * (d_own + ds[c]);
    near[c] = square < reach * reach;
  }
  near[first_own + (i - first)] = 0;
  // Eight tests are looked at together: nine in ten are misses, and then cost next to nothing.
  std::int32_t found = 0;
  for (std::int32_t c = 0; c < n; c += 8) {
    std::uint64_t any;
    std::memcpy(&any, near + c, sizeof any);
    if (any == 0) continue;
    for (std::int32_t k = c; k < c + 8; ++k) {
      hits[static_cast<std::size_t>(found)] = node[static_cast<std::size_t>(k)];
      found += near[k];
    }
  }
  return found;
}

// Insertion sort: the entries are few and nearly in order already.
template <int Dim>
void AdjacencyList<Dim>::sort_by_id(const Nodes<Dim>& nodes, std::int32_t* first,
                                    std::int32_t* last) {
  const std::int64_t* const id = nodes.id.data();
  for (std::int32_t* next = first; next < last; ++next) {
    const std::int32_t j = *next;
    const std::int64_t id_j = id[j];
    std::int32_t* at = next;
    for (; at > first && id[at[-1]] > id_j; --at) *at = at[-1];
    *at = j;
  }
}

// Appends the list of node i to `all`.
template <int Dim>
template <class Visible>
void AdjacencyList<Dim>::BlockWriter<Visible>::list(std::int64_t i) {
  const std::int32_t bucket = buckets.bucket_of(i);
  if (bucket != candidates.bucket) candidates.gather(nodes, buckets, bucket);
  const std::int32_t found = candidates.find(nodes, i, buckets.begin(bucket), radius, hits);
  const std::size_t first = all.size();
  for (std::int32_t h = 0; h < found; ++h) {
    const std::int32_t j = hits[static_cast<std::size_t>(h)];
    if (visible(i, j)) all.push_back(j);
  }
  sort_by_id(nodes, all.data() + first, all.data() + all.size());
}

template <int Dim>
template <class Visible>
void AdjacencyList<Dim>::BlockWriter<Visible>::operator()(std::int64_t block,
                                                          std::vector<std::int32_t>& out) {
  const std::int32_t pad = static_cast<std::int32_t>(nodes.count);
  std::array<std::size_t, kLanes + 1> start{};
  std::size_t longest = 0;
  all.clear();
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const std::int64_t i = block * kLanes + static_cast<std::int64_t>(lane);
    if (i < nodes.count) list(i);
    start[lane + 1] = all.size();
    longest = std::max(longest, start[lane + 1] - start[lane]);
  }
  for (std::size_t k = 0; k < longest; ++k)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t at = start[lane] + k;
      out.push_back(at < start[lane + 1] ? all[at] : pad);
    }
}

template <int Dim>
template <class Visible>
void AdjacencyList<Dim>::build(const Nodes<Dim>& nodes, const Buckets<Dim>& buckets, double radius,
                               const Visible& visible) {
  count_ = nodes.count;
  radius_ = radius;
  blocks_.build("pnpbs::AdjacencyList::build", block_count(), [&] {
    return BlockWriter<Visible>{nodes, buckets, radius, visible};
  });
}

}  // namespace pnpbs
