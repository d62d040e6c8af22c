// SPDX-License-Identifier: BSD-3-Clause
// The limit on the number of nodes of one rank. All ranks together may have 2^40 nodes, but a rank
// numbers its own nodes with 32 bits.
#pragma once

#include <cstdint>
#include <string>

#include "base/error.hpp"

namespace pnpbs {

// Largest number of nodes on a rank. The 64 numbers above it are reserved for the padding of
// blocks.
inline constexpr std::int64_t kMaxOnRank = (std::int64_t{1} << 31) - 64;

// Throws Error(ErrorKind::memory) if `count` exceeds this limit. `name` is the plural noun for the
// message.
inline void require_fits_rank(std::int64_t count, const char* name) {
  if (count <= kMaxOnRank) return;
  throw Error(ErrorKind::memory, "a rank would have " + std::to_string(count) + " " + name +
                                     ", and can have " + std::to_string(kMaxOnRank) +
                                     ": use more ranks");
}

}  // namespace pnpbs
