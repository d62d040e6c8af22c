// SPDX-License-Identifier: BSD-3-Clause
// What the writers write: one rank's part of the nodes, triangles and boundary edges. Together the
// parts are all of them, in the order of the ranks; nodes are numbered through, from 0.
#pragma once

#include <cstdint>
#include <vector>

#include "parallel/rank_span.hpp"

namespace pnpbs::io {

struct NodeBlock {
  RankSpan nodes;                  // which numbers are this rank's
  std::vector<double> xy;          // [nodes][2]
  std::vector<std::int64_t> ids;   // [nodes]
  std::vector<std::int32_t> tags;  // [nodes], 0: inner node
  std::vector<double> spacing;     // [nodes], d at the node

  bool is_piece = false;             // one of many, which stands for itself; then:
  std::vector<std::uint8_t> ghosts;  // [nodes], 1: another rank's

  bool elements = false;                // are the following given?
  RankSpan triangles;                   // counted as the nodes are
  std::vector<std::int64_t> corners;    // [triangles][3], numbers
  std::vector<float> quality;           // [triangles], 2 r_in / R
  RankSpan edges;                       // on boundary and inner curves
  std::vector<std::int64_t> edge_ends;  // [edges][2], numbers
  std::vector<std::int32_t> edge_tags;  // [edges]

  std::size_t size() const { return ids.size(); }
};

}  // namespace pnpbs::io
