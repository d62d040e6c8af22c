// SPDX-License-Identifier: BSD-3-Clause
#include "domain/volume/short_creases.hpp"

#include <algorithm>
#include <compare>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>

#include "base/space_vectors.hpp"

namespace pnpbs {

namespace {

// Least number of edges of a crease that is not short by its count.
constexpr std::size_t kEdgesOfLong = 6;
// Least length of a crease that is not short [extent of the mesh]
constexpr double kLengthOfLong = 0.1;

double extent_of_nodes(const BoundaryMesh<3>& mesh) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Point<3> low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  for (const BoundaryNode<3>& node : mesh.nodes)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], node.position[k]);
      high[k] = std::max(high[k], node.position[k]);
    }
  return length(difference(high, low));
}

class ShortCreases {
 public:
  ShortCreases(const BoundaryMesh<3>& mesh, std::span<const FeatureEdgeCandidate> edges)
      : mesh_(mesh), edges_(edges), dropped_(edges.size()), degree_(mesh.nodes.size()) {
    long_ = kLengthOfLong * extent_of_nodes(mesh);
    gather_edges_at_nodes();
  }

  std::vector<char> run() {
    drop_free_ends();
    drop_lone_ones();
    return std::move(dropped_);
  }

 private:
  using Chain = std::vector<std::int32_t>;  // indices of edges

  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  const FeatureEdgeCandidate& edge(std::int32_t e) const { return edges_[index(e)]; }

  void gather_edges_at_nodes() {
    begin_.assign(mesh_.nodes.size() + 1, 0);
    for (const FeatureEdgeCandidate& edge : edges_)
      for (const std::int32_t node : edge.nodes) ++begin_[index(node) + 1], ++degree_[index(node)];
    for (std::size_t n = 0; n < mesh_.nodes.size(); ++n) begin_[n + 1] += begin_[n];
    edges_at_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::int32_t e = 0; e < static_cast<std::int32_t>(edges_.size()); ++e)
      for (const std::int32_t node : edge(e).nodes) edges_at_[next[index(node)]++] = e;
  }

  // Calls visit(edge) for the remaining edges at a node.
  template <class Visit>
  void for_edges_at(std::int32_t node, const Visit& visit) const {
    for (std::size_t k = begin_[index(node)]; k < begin_[index(node) + 1]; ++k)
      if (dropped_[index(edges_at_[k])] == 0) visit(edges_at_[k]);
  }

  double length_of(const Chain& chain) const {
    double sum = 0;
    for (const std::int32_t e : chain)
      sum += distance<3>(mesh_.nodes[index(edge(e).nodes[0])].position,
                         mesh_.nodes[index(edge(e).nodes[1])].position);
    return sum;
  }
  bool is_short(const Chain& chain) const {
    return chain.size() < kEdgesOfLong && length_of(chain) < long_;
  }

  void drop(const Chain& chain) {
    for (const std::int32_t e : chain) {
      if (dropped_[index(e)] != 0) continue;
      dropped_[index(e)] = 1;
      for (const std::int32_t node : edge(e).nodes) --degree_[index(node)];
    }
  }

  // Returns the creases from a free end up to the next node where other than two edges meet, but no
  // more than kEdgesOfLong.
  Chain chain_from(std::int32_t node) const {
    Chain chain;
    std::int32_t last = -1;
    do {
      std::int32_t next = -1;
      for_edges_at(node, [&](std::int32_t e) {
        if (e != last) next = e;
      });
      if (!edge(next).crease) break;
      chain.push_back(next);
      last = next;
      node = edge(next).nodes[edge(next).nodes[0] == node ? 1 : 0];
    } while (degree_[index(node)] == 2 && chain.size() < kEdgesOfLong);
    return chain;
  }

  // The sort key of a chain from a free end: number of edges, then length, then the node at its
  // end.
  struct Branch {
    std::size_t edges;
    double length;
    std::int32_t end;

    auto operator<=>(const Branch&) const = default;
  };
  Branch branch_of(std::int32_t end, const Chain& chain) const {
    return {chain.size(), length_of(chain), end};
  }

  // Drops the shortest branch first, because the remaining edges may then form a long crease.
  void drop_free_ends() {
    std::priority_queue<Branch, std::vector<Branch>, std::greater<>> short_ones;
    const auto add = [&](std::int32_t node) {
      if (degree_[index(node)] != 1) return;
      if (const Chain chain = chain_from(node); !chain.empty() && is_short(chain))
        short_ones.push(branch_of(node, chain));
    };
    for (std::int32_t n = 0; n < static_cast<std::int32_t>(degree_.size()); ++n) add(n);
    while (!short_ones.empty()) {
      const Branch branch = short_ones.top();
      short_ones.pop();
      if (degree_[index(branch.end)] != 1) continue;  // dropped from its other end
      const Chain chain = chain_from(branch.end);
      if (branch_of(branch.end, chain) != branch) {  // longer now, since another branch was dropped
        add(branch.end);
        continue;
      }
      drop(chain);
      for (const std::int32_t e : chain)
        for (const std::int32_t node : edge(e).nodes) add(node);
    }
  }

  void drop_lone_ones() {
    std::vector<char> seen(edges_.size(), 0);
    for (std::int32_t seed = 0; seed < static_cast<std::int32_t>(edges_.size()); ++seed) {
      if (seen[index(seed)] != 0 || dropped_[index(seed)] != 0) continue;
      const Chain joined = joined_to(seed, seen);
      const auto is_crease = [&](std::int32_t e) { return edge(e).crease; };
      if (is_short(joined) && std::all_of(joined.begin(), joined.end(), is_crease)) drop(joined);
    }
  }

  // Returns all edges connected to this one.
  Chain joined_to(std::int32_t seed, std::vector<char>& seen) const {
    Chain joined{seed};
    seen[index(seed)] = 1;
    for (std::size_t k = 0; k < joined.size(); ++k)
      for (const std::int32_t node : edge(joined[k]).nodes)
        for_edges_at(node, [&](std::int32_t e) {
          if (seen[index(e)] == 0) joined.push_back(e);
          seen[index(e)] = 1;
        });
    return joined;
  }

  const BoundaryMesh<3>& mesh_;
  std::span<const FeatureEdgeCandidate> edges_;
  std::vector<char> dropped_;
  double long_ = 0;
  std::vector<std::int32_t> degree_;    // per mesh node: number of remaining edges
  std::vector<std::size_t> begin_;      // first index of each node in edges_at_
  std::vector<std::int32_t> edges_at_;  // includes dropped edges
};

}  // namespace

std::vector<char> short_creases(const BoundaryMesh<3>& mesh,
                                std::span<const FeatureEdgeCandidate> edges) {
  return ShortCreases(mesh, edges).run();
}

}  // namespace pnpbs
