// SPDX-License-Identifier: BSD-3-Clause
// Fields of the caller's in Gmsh's files: a view of values at nodes each.
#pragma once

#include <cstdint>
#include <vector>

#include "io/formats.hpp"

namespace pnpbs::io {

// In the order of the nodes' numbers. Collective.
void append_node_data(const NodeSource& nodes, SharedFile& file);

// In the order of blocks of nodes: rows have numbers, but not all readers look at them (meshio 5
// takes a row for the node that stands in its place).
class NodeDataByBlock {
 public:
  explicit NodeDataByBlock(const NodeSource& nodes) : nodes_(nodes) {}

  // Of each node of a window of for_nodes, the tag whose block it is in; kInside: that of the
  // inside.
  void add_window(const std::vector<std::int32_t>& blocks);
  // `order`: of the blocks in the file. Collective.
  void append(const std::vector<std::int32_t>& order, SharedFile& file) const;

  static constexpr std::int32_t kInside = 0;

 private:
  void append_field(std::size_t field, const std::vector<std::int32_t>& order,
                    SharedFile& file) const;

  const NodeSource& nodes_;
  std::vector<std::int32_t> blocks_;  // of the nodes in this rank's parts of all windows
};

}  // namespace pnpbs::io
