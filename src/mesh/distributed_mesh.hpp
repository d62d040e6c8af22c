// SPDX-License-Identifier: BSD-3-Clause
// A rank's part of a mesh: nodes, elements and facets that it owns, and those of others around
// them, in arrays as solvers take them. Indices are local and count from 0; numbers are global,
// and contiguous by rank.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "comm/communicator.hpp"
#include "formats/group_names.hpp"
#include "results/nodal_results.hpp"

namespace pnpbs {

struct DistributedMesh {
  int dimension = 0;  // of coordinates
  int corners = 0;    // of an element
  GeometryKind kind = GeometryKind::plane;

  // Owned ones first, in the order of their ids, so that their numbers count up; then the others,
  // by number.
  std::int64_t owned_nodes = 0, first_node = 0, all_nodes = 0;  // all: over all ranks
  std::vector<double> x;                                        // [nodes][dimension]
  std::vector<std::int64_t> numbers, ids;
  std::vector<std::int32_t> owners, tags;

  // The same of elements; an element is owned where its node with the least id is.
  std::int64_t owned_elements = 0, first_element = 0, all_elements = 0;
  std::vector<std::int32_t> element_corners;  // [elements][corners], indices of nodes
  std::vector<std::int64_t> element_numbers;
  std::vector<std::int32_t> element_owners, element_tags;

  // Those of elements that are here.
  std::vector<std::int32_t> facet_corners;   // [facets][corners - 1], indices of nodes
  std::vector<std::int32_t> facet_elements;  // [facets][2], indices; -1: not here, or none
  std::vector<std::int32_t> facet_opposite;  // in the first of them, the corner that it has not
  std::vector<std::int32_t> facet_tags, facet_owners;
  std::vector<std::int8_t> facet_inner;  // has it two elements, wherever they are?

  // Nodes that more than one rank owns or has in an element it owns, and all other such ranks of
  // each.
  std::vector<std::int32_t> shared_nodes;  // indices, by number
  std::vector<std::int64_t> sharing_offsets{0};
  std::vector<std::int32_t> sharing_ranks;  // increasing, of each node

  GroupNames names;  // of the domain's tags
};

// layers: of ghost elements. Those of the first have a node in common with the nodes and elements
// that a rank owns, those of the next with one of these. Collective.
std::unique_ptr<DistributedMesh> make_distributed_mesh(NodalResults& results, int layers);

}  // namespace pnpbs
