// SPDX-License-Identifier: BSD-3-Clause
// The rows "number x y ..." that mesh formats have for their nodes, numbered from 1.
#pragma once

#include "io/formats.hpp"

namespace pnpbs::io {

// rest(rows, i, sink) writes what follows the coordinates of a node, and ends the line.
template <class Rest>
void append_numbered_points(const NodeSource& nodes, SharedFile& file, const Rest& rest) {
  nodes.for_nodes([&](const NodeRows& rows) {
    file.append([&](Sink& sink) {
      std::int64_t number = rows.first;
      for (std::size_t i = 0; i < rows.ids.size(); ++i) {
        sink.number(++number);
        sink.text(" ");
        sink.number(rows.xy[2 * i]);
        sink.text(" ");
        sink.number(rows.xy[2 * i + 1]);
        rest(rows, i, sink);
      }
    });
  });
}

}  // namespace pnpbs::io
