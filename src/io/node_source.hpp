// SPDX-License-Identifier: BSD-3-Clause
// What the writers write: nodes, elements and the facets of boundary and inner surfaces, a window
// at a time, so that writing takes hardly any memory beside the nodes themselves. Elements are
// triangles in the plane and tetrahedra in space; facets are edges, and triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "domain/group_names.hpp"

namespace pnpbs::io {

// What all ranks hold together. Nodes, elements and facets are numbered through, from 0.
struct Contents {
  int dimension = 2;
  bool is_piece = false;       // one of many, which stands for itself and knows ghosts
  bool with_elements = false;  // and facets?
  std::int64_t nodes = 0, elements = 0, facets = 0;
  const GroupNames* names = nullptr;  // of tags; none of pieces

  int element_corners() const { return dimension + 1; }
  int facet_corners() const { return dimension; }
};

struct NodeRows {
  std::int64_t first = 0;            // number of the first one here
  std::vector<double> x;             // [nodes][dimension]
  std::vector<std::int64_t> ids;     // [nodes]
  std::vector<std::int32_t> tags;    // [nodes], 0: inner node
  std::vector<double> spacing;       // [nodes], d at the node
  std::vector<std::uint8_t> ghosts;  // [nodes], 1: another rank's; pieces only
};

struct ElementRows {
  std::int64_t first = 0;
  std::vector<std::int64_t> corners;  // [elements][dimension + 1], numbers
  std::vector<float> quality;         // [elements], 2 r_in / R, in space 3 r_in / R
};

struct FacetRows {  // on inner curves and surfaces, too
  std::int64_t first = 0;
  std::vector<std::int64_t> corners;  // [facets][dimension], numbers
  std::vector<std::int32_t> tags;     // [facets]
  std::vector<float> quality;         // [facets], 2 r_in / R; in space only
};

// All nodes, or all facets, with one tag.
struct TagGroup {
  std::int32_t tag;
  std::int64_t count = 0;
  std::array<double, 3> low, high;  // the box around them; z is 0 in the plane
};

class NodeSource {
 public:
  virtual ~NodeSource() = default;

  const Contents& contents() const { return contents_; }

  // Each call goes through all of them once: visit gets this rank's part of one window after the
  // other, empty ones included, and may do collective work. The parts of a window are in the order
  // of the ranks. Collective.
  virtual void for_nodes(const std::function<void(const NodeRows&)>& visit) const = 0;
  virtual void for_elements(const std::function<void(const ElementRows&)>& visit) const = 0;
  virtual void for_facets(const std::function<void(const FacetRows&)>& visit) const = 0;

  // By tag, of all ranks; none of pieces. Collective.
  virtual std::vector<TagGroup> node_groups() const { return {}; }
  virtual std::vector<TagGroup> facet_groups() const { return {}; }

 protected:
  Contents contents_;
};

}  // namespace pnpbs::io
