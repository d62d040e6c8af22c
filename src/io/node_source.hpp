// SPDX-License-Identifier: BSD-3-Clause
// What the writers write: nodes, triangles and boundary edges, a window at a time, so that writing
// takes hardly any memory beside the nodes themselves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace pnpbs::io {

// What all ranks hold together. Nodes, triangles and edges are numbered through, from 0.
struct Contents {
  bool is_piece = false;  // one of many, which stands for itself and knows ghosts
  bool elements = false;  // triangles and edges as well?
  std::int64_t nodes = 0, triangles = 0, edges = 0;
};

struct NodeRows {
  std::int64_t first = 0;            // number of the first one here
  std::vector<double> xy;            // [nodes][2]
  std::vector<std::int64_t> ids;     // [nodes]
  std::vector<std::int32_t> tags;    // [nodes], 0: inner node
  std::vector<double> spacing;       // [nodes], d at the node
  std::vector<std::uint8_t> ghosts;  // [nodes], 1: another rank's; pieces only
};

struct TriangleRows {
  std::int64_t first = 0;
  std::vector<std::int64_t> corners;  // [triangles][3], numbers
  std::vector<float> quality;         // [triangles], 2 r_in / R
};

struct EdgeRows {  // on boundary and inner curves
  std::int64_t first = 0;
  std::vector<std::int64_t> ends;  // [edges][2], numbers
  std::vector<std::int32_t> tags;  // [edges]
};

class NodeSource {
 public:
  virtual ~NodeSource() = default;

  const Contents& contents() const { return contents_; }

  // Each call goes through all of them once: visit gets this rank's part of one window after the
  // other, empty ones included, and may do collective work. The parts of a window are in the order
  // of the ranks. Collective.
  virtual void for_nodes(const std::function<void(const NodeRows&)>& visit) const = 0;
  virtual void for_triangles(const std::function<void(const TriangleRows&)>& visit) const = 0;
  virtual void for_edges(const std::function<void(const EdgeRows&)>& visit) const = 0;

 protected:
  Contents contents_;
};

}  // namespace pnpbs::io
