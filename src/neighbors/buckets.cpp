// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/buckets.hpp"

#include <algorithm>
#include <limits>
#include <utility>

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

// Counting sort; stable, so that nodes which stay keep their order.
template <int Dim>
bool Buckets<Dim>::order_nodes(std::int32_t buckets, Nodes<Dim>& nodes) {
  start_.assign(static_cast<std::size_t>(buckets) + 1, 0);
  bool ordered = true;
  for (std::int64_t i = 0; i < nodes.count; ++i) {
    ++start_[index(bucket_of_(i)) + 1];
    ordered = ordered && (i == 0 || bucket_of_(i - 1) <= bucket_of_(i));
  }
  for (std::int32_t b = 0; b < buckets; ++b) start_[index(b) + 1] += start_[index(b)];
  if (ordered) return false;
  from_ = nodes.order_scratch();
  std::vector<std::int32_t> next(start_.begin(), start_.end() - 1);
  for (std::int64_t i = 0; i < nodes.count; ++i)
    from_(next[index(bucket_of_(i))]++) = static_cast<std::int32_t>(i);
  nodes.permute(from_);
  for (std::int32_t b = 0; b < buckets; ++b)
    for (std::int32_t i = start_[index(b)]; i < start_[index(b) + 1]; ++i) bucket_of_(i) = b;
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
  least_.assign(static_cast<std::size_t>(buckets), std::numeric_limits<double>::infinity());
  std::vector<double> grown;  // reaches, if one is larger than it was
  for (std::int32_t b = 0; b < buckets; ++b) {
    double largest = 0;
    for (std::int32_t i = begin(b); i < end(b); ++i) {
      largest = std::max(largest, nodes.d(i));
      least_[index(b)] = std::min(least_[index(b)], nodes.d(i));
    }
    if (radius * largest <= links_->reach[index(b)]) continue;
    if (grown.empty()) grown = links_->reach;
    grown[index(b)] = radius * largest * kRoomForGrowth;
  }
  if (!grown.empty()) links_ = std::make_shared<const LeafLinks<Dim>>(tree, std::move(grown));
}

template class Buckets<2>;
template class Buckets<3>;

}  // namespace pnpbs
