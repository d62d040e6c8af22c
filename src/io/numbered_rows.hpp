// SPDX-License-Identifier: BSD-3-Clause
// The rows that mesh formats have for nodes, "number x y ...", and the corners that follow the
// number of an element: all numbered from 1.
#pragma once

#include "io/formats.hpp"

namespace pnpbs::io {

// rest(rows, i, sink) writes what follows the coordinates of a node, and ends the line.
template <class Rest>
void append_numbered_points(const NodeSource& nodes, SharedFile& file, const Rest& rest) {
  const auto coordinates = static_cast<std::size_t>(nodes.contents().coordinates);
  nodes.for_nodes([&](const NodeRows& rows) {
    file.append([&](Sink& sink) {
      std::int64_t number = rows.first;
      for (std::size_t i = 0; i < rows.ids.size(); ++i) {
        sink.number(++number);
        for (std::size_t k = 0; k < coordinates; ++k) {
          sink.text(" ");
          sink.number(rows.x[coordinates * i + k]);
        }
        rest(rows, i, sink);
      }
    });
  });
}

// Those of row i, each after a space.
inline void write_corners(const std::vector<std::int64_t>& corners, std::size_t i, int each,
                          Sink& sink) {
  const auto n = static_cast<std::size_t>(each);
  for (std::size_t k = n * i; k < n * (i + 1); ++k) {
    sink.text(" ");
    sink.number(corners[k] + 1);
  }
}

}  // namespace pnpbs::io
