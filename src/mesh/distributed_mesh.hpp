// SPDX-License-Identifier: BSD-3-Clause
// The part of a distributed mesh that one rank holds, in the arrays that parallel solvers take. It
// has the nodes, elements and facets that the rank owns and layers of ghosts around them. Indices
// are local and start at 0. Numbers are global, and each rank owns a contiguous range of them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "comm/communicator.hpp"
#include "formats/group_names.hpp"
#include "results/nodal_results.hpp"

namespace pnpbs {

struct DistributedMesh {
  int dimension = 0;  // number of coordinates per node
  int corners = 0;    // corners per element
  GeometryKind kind = GeometryKind::plane;

  // Nodes. Owned ones come first, in the order of their ids and so of their numbers. The ghosts
  // follow by increasing number.
  std::int64_t owned_nodes = 0, first_node = 0, all_nodes = 0;  // all_nodes: over all ranks
  std::vector<double> x;                                        // [nodes][dimension]
  std::vector<std::int64_t> numbers, ids;
  std::vector<std::int32_t> owners, tags;

  // Elements, in the same order. The rank that owns the corner with the smallest id owns the
  // element.
  std::int64_t owned_elements = 0, first_element = 0, all_elements = 0;
  std::vector<std::int32_t> element_corners;  // [elements][corners], indices of nodes
  std::vector<std::int64_t> element_numbers;
  std::vector<std::int32_t> element_owners, element_tags;

  // Facets of the elements of this rank, ghost elements included.
  std::vector<std::int32_t> facet_corners;  // [facets][corners - 1], indices of nodes
  // [facets][2], indices; -1: no element, or not on this rank
  std::vector<std::int32_t> facet_elements;
  // In the first of these elements, the corner opposite to the facet.
  std::vector<std::int32_t> facet_opposite;
  std::vector<std::int32_t> facet_tags, facet_owners;
  std::vector<std::int8_t> facet_inner;  // 1 if two elements share the facet, on whatever ranks

  // Nodes that several ranks own or have in an element that they own, with the other ranks of each.
  std::vector<std::int32_t> shared_nodes;  // local indices, in the order of numbers
  std::vector<std::int64_t> sharing_offsets{0};
  std::vector<std::int32_t> sharing_ranks;  // increasing for each node

  GroupNames names;  // names of the domain's tags
};

// Returns the mesh of `results` with `layers` layers of ghost elements. An element of the first
// layer has a node in common with the nodes and elements that the rank owns; one of the next layer,
// with those of the layer before. Collective.
std::unique_ptr<DistributedMesh> make_distributed_mesh(NodalResults& results, int layers);

}  // namespace pnpbs
