// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/buckets.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/counting_sort.hpp"

namespace pnpbs {

template <int Dim>
bool Buckets<Dim>::sort(const BackgroundTree<Dim>& tree, Nodes<Dim>& nodes, double radius) {
  find_buckets(tree, nodes);
  const bool reordered = order_nodes(tree.leaf_count(), nodes);
  gather_spacings(tree, nodes, radius);
  return reordered;
}

// Most nodes are still in their bucket of the last sort, which is tested first.
template <int Dim>
void Buckets<Dim>::find_buckets(const BackgroundTree<Dim>& tree, const Nodes<Dim>& nodes) {
  constexpr std::int64_t kChunk = 256;
  make_room(nodes.capacity());
  const View<std::int32_t> bucket = bucket_of_;
  const std::int64_t chunks = (nodes.count + kChunk - 1) / kChunk;
  for_each("pnpbs::Buckets::find", chunks, [&, bucket](std::int64_t chunk) {
    std::int32_t leaf = -1;  // the leaf of `box`
    Box<Dim> box{};
    for (std::int64_t i = chunk * kChunk; i < std::min((chunk + 1) * kChunk, nodes.count); ++i) {
      const Point<Dim> x = nodes.position(i);
      if (knows(i) && bucket(i) != leaf) {
        leaf = bucket(i);
        box = tree.fine_box(leaf);
      }
      bucket(i) = leaf >= 0 && tree.fine_box_holds(box, x) ? leaf : tree.leaf_at(x);
    }
  });
  known_ = nodes.count;
}

template <int Dim>
void Buckets<Dim>::make_room(std::int64_t n) {
  if (bucket_of_.extent(0) == 0)
    bucket_of_ = make_view<std::int32_t>("pnpbs::Buckets::bucket_of", n);
  else
    grow(bucket_of_, n, known_);
}

template <int Dim>
View<std::int32_t>& Buckets<Dim>::reset_buckets(const Nodes<Dim>& nodes) {
  known_ = 0;
  make_room(nodes.capacity());
  known_ = nodes.count;
  return bucket_of_;
}

template <int Dim>
void Buckets<Dim>::keep(const View<std::int32_t>& places, std::int64_t kept) {
  std::int64_t still_known = 0;
  for (std::int64_t k = 0; k < kept && places(k) < known_; ++k, ++still_known)
    bucket_of_(k) = bucket_of_(places(k));
  known_ = still_known;
}

// The sort is stable, so nodes that stay in their bucket keep their order.
template <int Dim>
bool Buckets<Dim>::order_nodes(std::int32_t buckets, Nodes<Dim>& nodes) {
  const View<std::int32_t> bucket = bucket_of_;
  const auto bucket_of = [bucket](std::int64_t i) { return bucket(i); };
  CountingSort sorted(nodes.count, buckets, bucket_of);
  start_ = sorted.start();
  if (sorted.in_order()) return false;
  from_ = nodes.order_scratch();
  const View<std::int32_t> from = from_;
  sorted.for_places(bucket_of, [from](std::int64_t i, std::int32_t place) {
    from(place) = static_cast<std::int32_t>(i);
  });
  nodes.permute(from_);
  for_each("pnpbs::Buckets::order_nodes", buckets, [&, bucket](std::int64_t b) {
    const auto leaf = static_cast<std::int32_t>(b);
    for (std::int32_t i = begin(leaf); i < end(leaf); ++i) bucket(i) = leaf;
  });
  return true;
}

// Builds new links if a bubble has become larger than the present ones allow.
template <int Dim>
void Buckets<Dim>::gather_spacings(const BackgroundTree<Dim>& tree, const Nodes<Dim>& nodes,
                                   double radius) {
  const std::int32_t buckets = tree.leaf_count();
  if (!links_)
    links_ = std::make_shared<const LeafGraph<Dim>>(
        tree, std::vector<double>(static_cast<std::size_t>(buckets), 0));
  min_.resize(static_cast<std::size_t>(buckets));
  for_each("pnpbs::Buckets::gather_spacings", buckets, [&](std::int64_t b) {
    const auto bucket = static_cast<std::int32_t>(b);
    double min = std::numeric_limits<double>::infinity();
    for (std::int32_t i = begin(bucket); i < end(bucket); ++i) min = std::min(min, nodes.d(i));
    min_[index(bucket)] = min;
  });
  const auto max_in = [&](std::int32_t bucket) {
    double max = 0;
    for (std::int32_t i = begin(bucket); i < end(bucket); ++i) max = std::max(max, nodes.d(i));
    return max;
  };
  const double grown = max_of("pnpbs::Buckets::grown", buckets, 0.0, [&](std::int64_t b) {
    const auto bucket = static_cast<std::int32_t>(b);
    return radius * max_in(bucket) > links_->reach(bucket) ? 1.0 : 0.0;
  });
  if (grown == 0) return;
  std::vector<double> reach = links_->reaches();
  for (std::int32_t b = 0; b < buckets; ++b) {
    const double max = radius * max_in(b);
    if (max > reach[index(b)]) reach[index(b)] = max * kRoomForGrowth;
  }
  links_ = std::make_shared<const LeafGraph<Dim>>(tree, std::move(reach), links_->stretches());
}

template class Buckets<2>;
template class Buckets<3>;

}  // namespace pnpbs
