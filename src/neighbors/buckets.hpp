// SPDX-License-Identifier: BSD-3-Clause
// Multilayer buckets: the leaves of the background tree, each layer of the tree for bubbles of
// its size, and for each bucket the buckets whose bubbles may meet its own (section 2.3).
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "base/nodes.hpp"
#include "tree/background_tree.hpp"
#include "tree/leaf_graph.hpp"

namespace pnpbs {

template <int Dim>
class Buckets {
 public:
  // Sorts the nodes in memory by bucket, and sees to it that the neighbour buckets of each reach
  // all bubbles within radius * (d_i + d_j) / 2. Returns whether nodes changed their places.
  bool sort(const BackgroundTree<Dim>& tree, Nodes<Dim>& nodes, double radius);

  // If they did: what is at i now was at order()(i).
  const View<std::int32_t>& order() const { return from_; }

  // The tree has changed; its leaves are linked like that.
  void reset(std::shared_ptr<const LeafLinks<Dim>> links) {
    links_ = std::move(links);
    known_ = 0;
  }

  // These have come in place of those that were sorted: room for the bucket of each, to be written.
  View<std::int32_t>& buckets_of_new(const Nodes<Dim>& nodes);
  // The first `kept` nodes named have been kept, as by Nodes::keep.
  void keep(const View<std::int32_t>& places, std::int64_t kept);
  // Has node i a bucket, from when the nodes were stored or sorted? Those appended since then have
  // none.
  bool knows(std::int64_t i) const { return i < known_; }

  std::int32_t bucket_of(std::int64_t node) const { return bucket_of_(node); }
  std::int32_t begin(std::int32_t bucket) const { return start_[index(bucket)]; }
  std::int32_t end(std::int32_t bucket) const { return start_[index(bucket) + 1]; }

  // Calls visit(other) for the bucket itself and all that may interact with it, in Morton order.
  template <class Visit>
  void for_neighbours(std::int32_t bucket, const Visit& visit) const {
    links_->graph.for_neighbours(bucket, visit);
  }

  // Least spacing of the nodes in a bucket (infinity if empty).
  double min_spacing(std::int32_t bucket) const { return min_[index(bucket)]; }

 private:
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  void make_room(std::int64_t n);
  void find_buckets(const BackgroundTree<Dim>& tree, const Nodes<Dim>& nodes);
  bool order_nodes(std::int32_t buckets, Nodes<Dim>& nodes);
  void gather_spacings(const BackgroundTree<Dim>& tree, const Nodes<Dim>& nodes, double radius);

  View<std::int32_t> bucket_of_;     // where a node was when they were sorted last
  std::int64_t known_ = 0;           // nodes of which that is known, the first ones
  std::vector<std::int32_t> start_;  // first node of each bucket
  std::vector<double> min_;          // least d of the nodes in it
  std::shared_ptr<const LeafLinks<Dim>> links_;
  View<std::int32_t> from_;
};

extern template class Buckets<2>;
extern template class Buckets<3>;

}  // namespace pnpbs
