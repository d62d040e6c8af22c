// SPDX-License-Identifier: BSD-3-Clause
// Who owns which leaf of the background tree, and who needs its nodes as ghosts.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "tree/leaf_graph.hpp"

namespace pnpbs {

// The ghost layers for one depth, in hops of the leaf graph.
class Halo {
 public:
  // Ranks that own a leaf or lie within the depth of it, in increasing order.
  template <class Visit>
  void for_ranks(std::int32_t leaf, const Visit& visit) const {
    for (std::int32_t k = offset_[static_cast<std::size_t>(leaf)];
         k < offset_[static_cast<std::size_t>(leaf) + 1]; ++k)
      visit(ranks_[static_cast<std::size_t>(k)]);
  }
  // Ranks to exchange messages with. Symmetric: who is our neighbour has us as one. One hop more
  // than the depth, because nodes drift out of their leaves between exchanges.
  const std::vector<int>& neighbours() const { return neighbours_; }

 private:
  friend class Distribution;
  std::vector<std::int32_t> offset_, ranks_;
  std::vector<int> neighbours_;
};

class Distribution {
 public:
  Distribution() = default;
  Distribution(const LeafGraph<2>* graph, std::vector<std::int32_t> owner, int rank)
      : graph_(graph), owner_(std::move(owner)), rank_(rank) {}

  bool owns(std::int32_t leaf) const {
    return owner_.empty() || owner_[static_cast<std::size_t>(leaf)] == rank_;
  }
  int owner(std::int32_t leaf) const { return owner_[static_cast<std::size_t>(leaf)]; }
  const std::vector<std::int32_t>& owners() const { return owner_; }

  // Made on first use and kept.
  const Halo& halo(int hops);

 private:
  const LeafGraph<2>* graph_ = nullptr;
  std::vector<std::int32_t> owner_;
  int rank_ = 0;
  std::map<int, Halo> halos_;
};

}  // namespace pnpbs
