// SPDX-License-Identifier: BSD-3-Clause
// From numbers to the local indices that a solver takes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "mesh/distributed_mesh.hpp"
#include "mesh/mesh_records.hpp"
#include "mesh/node_sharing.hpp"
#include "mesh/rank_ranges.hpp"

namespace pnpbs {

// Fills the arrays of a mesh. Indices of nodes and elements from their numbers.
template <std::size_t Corners>
class MeshArrays {
 public:
  MeshArrays(DistributedMesh& mesh, const RankRanges& nodes, const RankRanges& elements)
      : mesh_(mesh), nodes_(nodes), elements_(elements) {
    mesh.corners = static_cast<int>(Corners);
    mesh.owned_nodes = nodes.count();
    mesh.first_node = nodes.first();
    mesh.all_nodes = nodes.total();
    mesh.owned_elements = elements.count();
    mesh.first_element = elements.first();
    mesh.all_elements = elements.total();
  }

  // To so many nodes and elements, owned ones included, that are then added.
  void resize(std::size_t nodes, std::size_t elements) {
    mesh_.x.resize(nodes * static_cast<std::size_t>(mesh_.dimension));
    for (auto* array : {&mesh_.numbers, &mesh_.ids}) array->resize(nodes);
    for (auto* array : {&mesh_.owners, &mesh_.tags}) array->resize(nodes);
    mesh_.element_corners.resize(elements * Corners);
    mesh_.element_numbers.resize(elements);
    for (auto* array : {&mesh_.element_owners, &mesh_.element_tags}) array->resize(elements);
  }

  // Owned ones first, then the others by number.
  void add(const MeshNode& node) {
    const std::size_t n = node_count_++, dim = static_cast<std::size_t>(mesh_.dimension);
    std::copy_n(node.x.begin(), dim, mesh_.x.begin() + static_cast<std::ptrdiff_t>(dim * n));
    mesh_.numbers[n] = node.number;
    mesh_.ids[n] = node.id;
    mesh_.owners[n] = nodes_.owner(node.number);
    mesh_.tags[n] = node.tag;
  }
  // Likewise, after the nodes.
  void add(const MeshElement<Corners>& element) {
    const std::size_t e = element_count_++;
    for (std::size_t k = 0; k < Corners; ++k)
      mesh_.element_corners[Corners * e + k] = node_index(element.corners[k]);
    mesh_.element_numbers[e] = element.number;
    mesh_.element_owners[e] = elements_.owner(element.number);
    mesh_.element_tags[e] = element.tag;
  }
  // After the elements.
  void add(const MeshFacet<Corners>& facet) {
    const std::size_t here = element_index(facet.elements[0]) >= 0 ? 0 : 1;
    for (const std::int64_t corner : facet.corners)
      mesh_.facet_corners.push_back(node_index(corner));
    mesh_.facet_elements.push_back(element_index(facet.elements[here]));
    mesh_.facet_elements.push_back(here == 0 ? element_index(facet.elements[1]) : -1);
    mesh_.facet_opposite.push_back(facet.opposite[here]);
    mesh_.facet_tags.push_back(facet.tag);
    mesh_.facet_owners.push_back(elements_.owner(facet.elements[0]));
    mesh_.facet_inner.push_back(facet.elements[1] != kNoElement);
  }
  void add(const NodeShare& share) {
    const std::int32_t node = node_index(share.node);
    if (mesh_.shared_nodes.empty() || mesh_.shared_nodes.back() != node) {
      mesh_.shared_nodes.push_back(node);
      mesh_.sharing_offsets.push_back(mesh_.sharing_offsets.back());
    }
    mesh_.sharing_ranks.push_back(share.rank);
    ++mesh_.sharing_offsets.back();
  }

 private:
  // -1: not here.
  static std::int32_t index(const RankRanges& ranges, const std::vector<std::int64_t>& numbers,
                            std::int64_t number) {
    if (ranges.has(number)) return static_cast<std::int32_t>(number - ranges.first());
    const auto others = numbers.begin() + ranges.count();
    const auto found = std::lower_bound(others, numbers.end(), number);
    if (found == numbers.end() || *found != number) return -1;
    return static_cast<std::int32_t>(found - numbers.begin());
  }
  std::int32_t node_index(std::int64_t number) const {
    return index(nodes_, mesh_.numbers, number);
  }
  std::int32_t element_index(std::int64_t number) const {
    return index(elements_, mesh_.element_numbers, number);
  }

  DistributedMesh& mesh_;
  const RankRanges& nodes_;
  const RankRanges& elements_;
  std::size_t node_count_ = 0, element_count_ = 0;  // added so far
};

}  // namespace pnpbs
