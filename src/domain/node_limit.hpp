// SPDX-License-Identifier: BSD-3-Clause
// Limits on the number of nodes and on their memory.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "base/message_text.hpp"

namespace pnpbs {

// Memory of a node at the end of a run, with its share of lists and tree. [bytes] Measured: 222 to
// 246, rounded up for ghosts.
inline constexpr double kBytesPerNode = 260;

// The largest numbers of nodes and bytes that a run may use.
struct NodeLimit {
  NodeLimit(std::int64_t nodes, double bytes = std::numeric_limits<double>::infinity())
      : max_nodes(nodes), max_bytes(bytes) {}

  // Throws Error(ErrorKind::spacing) with the number of nodes that the spacing implies. `place`
  // names the location of the smallest d.
  [[noreturn]] void report_too_many(double nodes, double d, const MessageText& place) const;
  // Throws Error(ErrorKind::memory) if `nodes` objects of `bytes_per_node` exceed max_bytes. `name`
  // is the name of these objects in the message.
  void require_memory_for(double nodes, double bytes_per_node = kBytesPerNode,
                          const char* name = "nodes") const;

  std::int64_t max_nodes;  // a larger number is taken for a mistake in d
  double max_bytes;        // memory of all ranks together
  bool resolves = false;   // true if the option resolve may reduce d; messages then mention it
};

}  // namespace pnpbs
