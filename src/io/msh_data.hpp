// SPDX-License-Identifier: BSD-3-Clause
// Output fields in Gmsh's files, one view of nodal values for each.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "io/formats.hpp"
#include "io/shared_file.hpp"

namespace pnpbs::io {

// Rows of tagged nodes or facets that are kept in memory, to be written tag by tag. Each rank keeps
// the rows of its parts of the windows, which are few compared with inner nodes. `Row` must have a
// member `tag`.
template <class Row>
class RowsByTag {
 public:
  // Adds the rows of a window; all ranks must add the same windows. A single rank joins all
  // windows, since they are already in order.
  void add_window(std::vector<Row> rows, const Communicator& comm) {
    if (comm.size() == 1 && !windows_.empty())
      windows_.front().insert(windows_.front().end(), rows.begin(), rows.end());
    else
      windows_.push_back(std::move(rows));
  }

  void sort() {
    for (std::vector<Row>& window : windows_) std::ranges::stable_sort(window, {}, &Row::tag);
  }

  // Calls write(row, sink) for the rows with this tag, in their order over all ranks. sort() must
  // have been called. Collective.
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

// Appends all fields in the order of the nodes' numbers. Collective.
void append_node_data(const NodeSource& nodes, SharedFile& file);

// The output fields in the order of the blocks of nodes. The rows have numbers, but meshio 5
// ignores them and assigns rows to nodes by position.
class NodeDataByBlock {
 public:
  explicit NodeDataByBlock(const NodeSource& nodes) : nodes_(nodes) {}

  // Adds the block of each node of a window of for_nodes(); kInside for nodes that are streamed.
  void add_window(const std::vector<std::int32_t>& blocks);
  // Appends the fields. `order` lists the blocks in the order of the file. Collective.
  void append(const std::vector<std::int32_t>& order, SharedFile& file) const;

  static constexpr std::int32_t kInside = 0;

 private:
  void append_field(std::size_t field, const std::vector<std::int32_t>& order,
                    SharedFile& file) const;

  const NodeSource& nodes_;
  std::vector<std::int32_t> blocks_;  // by node of this rank, over all windows
};

}  // namespace pnpbs::io
