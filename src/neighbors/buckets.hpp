// SPDX-License-Identifier: BSD-3-Clause
// Multilayer buckets (section 2.3 of the paper): the leaves of the background tree, whose layers
// suit bubbles of different sizes, and for each bucket the buckets whose bubbles may interact with
// its own.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "base/nodes.hpp"
#include "tree/background_tree.hpp"
#include "tree/leaf_graph.hpp"

namespace pnpbs {

// The nodes of a rank sorted by leaf of the background tree.
template <int Dim>
class Buckets {
 public:
  // Sorts the nodes in memory by bucket and extends the links of buckets, if necessary, to all
  // pairs of bubbles within radius * (d_i + d_j) / 2. Returns true if nodes have changed their
  // indices.
  bool sort(const BackgroundTree<Dim>& tree, Nodes<Dim>& nodes, double radius);

  // Returns the permutation of the last sort that returned true: the node at i was at order()(i)
  // before.
  const View<std::int32_t>& order() const { return from_; }

  // Must be called after the tree has changed. `links` are the links of its leaves.
  void reset(std::shared_ptr<const LeafGraph<Dim>> links) {
    links_ = std::move(links);
    known_ = 0;
  }

  // Returns an array for the buckets of nodes that replace the sorted ones. The caller must write
  // the bucket of each node.
  View<std::int32_t>& reset_buckets(const Nodes<Dim>& nodes);
  // Keeps the same nodes as Nodes::keep; must be called with the same arguments.
  void keep(const View<std::int32_t>& places, std::int64_t kept);
  // Returns true if the bucket of node i is stored. Nodes appended after the last sort have none.
  bool knows(std::int64_t i) const { return i < known_; }

  std::int32_t bucket_of(std::int64_t node) const { return bucket_of_(node); }
  std::int32_t begin(std::int32_t bucket) const { return start_[index(bucket)]; }
  std::int32_t end(std::int32_t bucket) const { return start_[index(bucket) + 1]; }

  // Calls visit(other) for the bucket itself and all buckets that may interact with it, in Morton
  // order.
  template <class Visit>
  void for_neighbours(std::int32_t bucket, const Visit& visit) const {
    links_->for_neighbours(bucket, visit);
  }

  // Returns the smallest spacing of the nodes in a bucket, or infinity if it is empty.
  double min_spacing(std::int32_t bucket) const { return min_[index(bucket)]; }

 private:
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  void make_room(std::int64_t n);
  void find_buckets(const BackgroundTree<Dim>& tree, const Nodes<Dim>& nodes);
  bool order_nodes(std::int32_t buckets, Nodes<Dim>& nodes);
  void gather_spacings(const BackgroundTree<Dim>& tree, const Nodes<Dim>& nodes, double radius);

  View<std::int32_t> bucket_of_;     // as of the last sort
  std::int64_t known_ = 0;           // number of leading nodes with an entry in bucket_of_
  std::vector<std::int32_t> start_;  // index of the first node of each bucket
  std::vector<double> min_;          // smallest d in each bucket
  std::shared_ptr<const LeafGraph<Dim>> links_;
  View<std::int32_t> from_;
};

extern template class Buckets<2>;
extern template class Buckets<3>;

}  // namespace pnpbs
