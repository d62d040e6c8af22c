// SPDX-License-Identifier: BSD-3-Clause
// Layers of elements of other ranks around those of a rank.
#pragma once

#include <cstdint>
#include <unordered_set>
#include <vector>

#include "mesh/ask_owners.hpp"
#include "mesh/elements_at_nodes.hpp"

namespace pnpbs {

// The nodes of elements that other ranks own, each once.
template <std::size_t Corners, class Elements>
std::vector<std::int64_t> nodes_of_others(const RankRanges& nodes, const Elements& elements) {
  std::vector<std::int64_t> numbers;
  for (const MeshElement<Corners>& element : elements)
    for (const std::int64_t corner : element.corners)
      if (!nodes.has(corner)) numbers.push_back(corner);
  sort_and_keep_one(numbers);
  return numbers;
}

// By their numbers. All elements at owned nodes are known; those at other nodes, as far as the
// layers reach, are asked of the owners of these nodes. front: those of the elements that this rank
// owns. Collective.
template <std::size_t Corners>
std::vector<MeshElement<Corners>> ghost_elements(const Communicator& comm, const RankRanges& nodes,
                                                 const RankRanges& elements,
                                                 const ElementsAtNodes<Corners>& at_nodes,
                                                 std::vector<std::int64_t> front, int layers) {
  using Element = MeshElement<Corners>;
  const auto number = [](const Element& element) { return element.number; };
  const auto give = [&](std::int64_t node, int rank, std::vector<Element>& answers) {
    at_nodes.at(node, [&](const Element& element) {
      if (elements.owner(element.number) != rank) answers.push_back(element);
    });
  };
  if (layers == 0) return {};
  std::vector<Element> ghosts(at_nodes.of_others().begin(), at_nodes.of_others().end());
  std::unordered_set<std::int64_t> asked;
  for (int layer = 1;; ++layer) {
    for (const Element& element : ask_owners<Element>(comm, nodes, front, give, number))
      ghosts.push_back(element);
    sort_and_keep_one(ghosts, number);
    if (layer == layers) return ghosts;
    asked.insert(front.begin(), front.end());
    front = nodes_of_others<Corners>(nodes, ghosts);
    std::erase_if(front, [&](std::int64_t node) { return asked.contains(node); });
  }
}

}  // namespace pnpbs
