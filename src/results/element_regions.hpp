// SPDX-License-Identifier: BSD-3-Clause
// The regions of the domain in which elements lie.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "results/results.hpp"

namespace pnpbs {

// Finds the region of an element or a node. Tags of nodes are stored once they are computed.
template <int Dim>
class ElementRegions {
 public:
  // Prepares for the elements of results.for_elements().
  explicit ElementRegions(const Results<Dim>& results)
      : results_(results),
        regions_(results.has_nodes() ? results.level().geometry.domain().regions() : nullptr) {
    if (regions_) of_node_.assign(static_cast<std::size_t>(results.held()), kUnknown);
  }

  bool any() const { return regions_ != nullptr; }

  // Returns the tag of the region of an element, or 0 without one. `places` are the result indices
  // of its corners. Elements end at the facets of regions, so their tag is that of any corner that
  // lies on no facet; the one with the smallest id is used. If all corners lie on facets, it is the
  // tag at the centroid.
  std::int32_t operator()(const std::array<std::int64_t, Dim + 1>& places) {
    if (!regions_) return 0;
    std::array<std::int64_t, Dim + 1> nodes;
    std::ranges::transform(places, nodes.begin(), [&](auto p) { return results_.node_at(p); });
    return of_element(nodes);
  }

  // Returns the same for an element with these nodes. Requires any().
  std::int32_t of_element(std::array<std::int64_t, Dim + 1> nodes) {
    std::ranges::sort(nodes, {}, [&](std::int64_t i) { return all().id(i); });
    for (const std::int64_t i : nodes)
      if (all().tag(i) == 0) return at_node(i);
    Point<Dim> middle{};
    for (const std::int64_t i : nodes)
      for (std::size_t k = 0; k < Dim; ++k) middle[k] += all().position(i)[k] / (Dim + 1);
    return regions_->tag_at(middle);
  }

  // Returns the tag of the region that contains node i, by its position. Requires any().
  std::int32_t at_node(std::int64_t i) {
    std::int64_t& known = of_node_[static_cast<std::size_t>(i)];
    if (known == kUnknown) known = regions_->tag_at(all().position(i));
    return static_cast<std::int32_t>(known);
  }

 private:
  static constexpr std::int64_t kUnknown = std::int64_t{1} << 40;  // no tag has this value

  const Nodes<Dim>& all() const { return results_.level().nodes; }

  const Results<Dim>& results_;
  const RegionIndex<Dim>* regions_;
  std::vector<std::int64_t> of_node_;
};

}  // namespace pnpbs
