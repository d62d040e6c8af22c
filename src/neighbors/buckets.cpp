// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/buckets.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/counting_sort.hpp"

namespace pnpbs {

template <int Dim>
bool Buckets<Dim>::sort(const BackgroundTree<Dim>& tree, Nodes<Dim>& nodes, double radius) {
  find_buckets(tree, nodes);
  const bool reordered = order_nodes(tree.leaf_count(), nodes);
  gather_spacings(tree, nodes, radius);
  return reordered;
}

// Most nodes are where they were when they were sorted last: each bucket asks for its own first.
template <int Dim>
void Buckets<Dim>::find_buckets(const BackgroundTree<Dim>& tree, const Nodes<Dim>& nodes) {
  if (static_cast<std::int64_t>(bucket_of_.extent(0)) < nodes.capacity())
    bucket_of_ = make_view<std::int32_t>("pnpbs::Buckets::bucket_of", nodes.capacity());
  const bool was_sorted = start_.size() == static_cast<std::size_t>(tree.leaf_count()) + 1;
  const auto known = was_sorted ? std::min<std::int64_t>(start_.back(), nodes.count) : 0;
  const View<std::int32_t> bucket = bucket_of_;
  if (was_sorted)
    for_each("pnpbs::Buckets::find_near", tree.leaf_count(), [&, bucket](std::int64_t b) {
      const std::int32_t leaf = static_cast<std::int32_t>(b);
      const Box<Dim> box = tree.fine_box(leaf);
      for (std::int64_t i = begin(leaf); i < std::min<std::int64_t>(end(leaf), known); ++i) {
        const Point<Dim> x = nodes.position(i);
        bucket(i) = tree.fine_box_holds(box, x) ? leaf : tree.leaf_at(x);
      }
    });
  for_each("pnpbs::Buckets::find", nodes.count - known, [&, bucket](std::int64_t k) {
    bucket(known + k) = tree.leaf_at(nodes.position(known + k));
  });
}

// Stable, so that nodes which stay keep their order.
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

// The links are made anew if a bubble became larger than they allow.
template <int Dim>
void Buckets<Dim>::gather_spacings(const BackgroundTree<Dim>& tree, const Nodes<Dim>& nodes,
                                   double radius) {
  const std::int32_t buckets = tree.leaf_count();
  if (!links_)
    links_ = std::make_shared<const LeafLinks<Dim>>(
        tree, std::vector<double>(static_cast<std::size_t>(buckets), 0));
  least_.resize(static_cast<std::size_t>(buckets));
  const auto largest_in = [&](std::int32_t bucket) {
    double largest = 0;
    for (std::int32_t i = begin(bucket); i < end(bucket); ++i)
      largest = std::max(largest, nodes.d(i));
    return largest;
  };
  const double grown =
      largest_of("pnpbs::Buckets::gather_spacings", buckets, 0.0, [&](std::int64_t b) {
        const auto bucket = static_cast<std::int32_t>(b);
        double least = std::numeric_limits<double>::infinity();
        for (std::int32_t i = begin(bucket); i < end(bucket); ++i)
          least = std::min(least, nodes.d(i));
        least_[index(bucket)] = least;
        return radius * largest_in(bucket) > links_->reach[index(bucket)] ? 1.0 : 0.0;
      });
  if (grown == 0) return;
  std::vector<double> reach = links_->reach;
  for (std::int32_t b = 0; b < buckets; ++b) {
    const double largest = radius * largest_in(b);
    if (largest > reach[index(b)]) reach[index(b)] = largest * kRoomForGrowth;
  }
  links_ = std::make_shared<const LeafLinks<Dim>>(tree, std::move(reach));
}

template class Buckets<2>;
template class Buckets<3>;

}  // namespace pnpbs
