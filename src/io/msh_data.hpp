// SPDX-License-Identifier: BSD-3-Clause
// Fields of the caller's in Gmsh's files: a view of values at nodes each.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "io/formats.hpp"
#include "io/shared_file.hpp"

namespace pnpbs::io {

// Rows of tagged nodes or facets, to be written tag by tag: each rank keeps those of its parts of
// the windows, which are few beside the nodes inside. Row: has a tag.
template <class Row>
class RowsByTag {
 public:
  // Of one window after the other, on all ranks. One rank alone has them in order anyway.
  void add_window(std::vector<Row> rows, const Communicator& comm) {
    if (comm.size() == 1 && !windows_.empty())
      windows_.front().insert(windows_.front().end(), rows.begin(), rows.end());
    else
      windows_.push_back(std::move(rows));
  }

  void sort() {
    for (std::vector<Row>& window : windows_) std::ranges::stable_sort(window, {}, &Row::tag);
  }

  // Calls write(row, sink) for the rows with this tag, in their order over all ranks. Collective,
  // after sort().
  template <class Write>
  void append(std::int32_t tag, SharedFile& file, const Write& write) const {
    for (const std::vector<Row>& window : windows_) {
      const auto begin = std::ranges::lower_bound(window, tag, {}, &Row::tag);
      const auto end = std::ranges::upper_bound(window, tag, {}, &Row::tag);
      file.append([&](Sink& sink) {
        for (auto row = begin; row != end; ++row) write(*row, sink);
      });
    }
  }

 private:
  std::vector<std::vector<Row>> windows_;
};

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
