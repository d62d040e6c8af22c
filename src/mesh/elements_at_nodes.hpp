// SPDX-License-Identifier: BSD-3-Clause
// Elements at the nodes that a rank owns, including elements that other ranks own.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/rank_limit.hpp"
#include "mesh/mesh_records.hpp"

namespace pnpbs {

// The elements that a rank owns, those of other ranks at its owned nodes, and a map from each owned
// node to all elements at it.
template <std::size_t Corners>
class ElementsAtNodes {
 public:
  using Element = MeshElement<Corners>;

  // Sends `own`, the elements of this rank, to the owners of their corners. Collective.
  ElementsAtNodes(const Communicator& comm, const RankRanges& nodes, std::vector<Element> own)
      : nodes_(nodes), elements_(std::move(own)), owned_(elements_.size()) {
    gather(comm);
    sort_by_node();
  }

  std::span<const Element> own() const { return std::span(elements_).first(owned_); }
  std::span<const Element> of_others() const { return std::span(elements_).subspan(owned_); }
  // Returns the sorted numbers of those corners of owned elements that other ranks own.
  const std::vector<std::int64_t>& nodes_of_others() const { return nodes_of_others_; }
  // Calls visit(element) for each element at `node`, which this rank must own.
  template <class Visit>
  void at(std::int64_t node, const Visit& visit) const {
    const std::size_t k = static_cast<std::size_t>(node - nodes_.first());
    for (std::int64_t e = offsets_[k]; e < offsets_[k + 1]; ++e)
      visit(elements_[static_cast<std::size_t>(entries_[static_cast<std::size_t>(e)])]);
  }

 private:
  void gather(const Communicator& comm) {
    Outbox outgoing;
    std::vector<int> ranks;
    for (const Element& element : elements_) {
      ranks.clear();
      for (const std::int64_t corner : element.corners) {
        if (nodes_.has(corner)) continue;
        nodes_of_others_.push_back(corner);
        ranks.push_back(nodes_.owner(corner));
      }
      if (ranks.empty()) continue;
      sort_and_keep_one(ranks);
      for (const int rank : ranks) pack(outgoing.to(rank), element);
    }
    sort_and_keep_one(nodes_of_others_);
    const std::vector<Element> arrived = deliver<Element>(comm, outgoing);
    elements_.insert(elements_.end(), arrived.begin(), arrived.end());
  }

  // Builds the compressed rows of elements by owned node.
  void sort_by_node() {
    require_fits_rank(std::ssize(elements_), "elements");
    const auto for_own_corners = [&](const auto& visit) {
      for (std::size_t e = 0; e < elements_.size(); ++e)
        for (const std::int64_t corner : elements_[e].corners)
          if (nodes_.has(corner)) visit(e, static_cast<std::size_t>(corner - nodes_.first()));
    };
    offsets_.assign(static_cast<std::size_t>(nodes_.count()) + 1, 0);
    for_own_corners([&](std::size_t, std::size_t node) { ++offsets_[node + 1]; });
    for (std::size_t node = 1; node < offsets_.size(); ++node) offsets_[node] += offsets_[node - 1];
    entries_.resize(static_cast<std::size_t>(offsets_.back()));
    std::vector<std::int64_t> next = offsets_;
    for_own_corners([&](std::size_t e, std::size_t node) {
      entries_[static_cast<std::size_t>(next[node]++)] = static_cast<std::int32_t>(e);
    });
  }

  const RankRanges& nodes_;
  std::vector<Element> elements_;  // owned elements come first
  std::size_t owned_;
  std::vector<std::int64_t> nodes_of_others_;
  std::vector<std::int64_t> offsets_;  // first entry of each owned node in entries_
  std::vector<std::int32_t> entries_;  // indices in elements_
};

}  // namespace pnpbs
