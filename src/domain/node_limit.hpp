// SPDX-License-Identifier: BSD-3-Clause
// How many nodes there may be.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "base/message_text.hpp"

namespace pnpbs {

// What a node takes at the end of a run, its share of lists and tree included: measured as 222 to
// 246 bytes, and some for ghosts.
inline constexpr double kBytesPerNode = 260;

struct NodeLimit {
  NodeLimit(std::int64_t nodes, double bytes = std::numeric_limits<double>::infinity())
      : max_nodes(nodes), max_bytes(bytes) {}

  // Throws Error(ErrorKind::spacing): there would be so many, and d is least near that place.
  [[noreturn]] void report_too_many(double nodes, double d, const MessageText& place) const;
  // Throws Error(ErrorKind::memory) if so many nodes, and all that is kept of them, would not fit.
  // So of anything else that is made for them, if it is named.
  void require_memory_for(double nodes, double bytes_per_node = kBytesPerNode,
                          const char* name = "nodes") const;

  std::int64_t max_nodes;  // more are taken for a mistake in d
  double max_bytes;        // of memory, on all ranks together
  bool resolves = false;   // d may be held down by the option resolve, and messages say so
};

}  // namespace pnpbs
