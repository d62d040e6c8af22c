// SPDX-License-Identifier: BSD-3-Clause
// Rows of tagged nodes or facets, to be written tag by tag: each rank keeps those of its parts of
// the windows, which are few beside the nodes inside.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "io/shared_file.hpp"

namespace pnpbs::io {

// Row: has a tag.
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

}  // namespace pnpbs::io
