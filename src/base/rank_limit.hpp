// SPDX-License-Identifier: BSD-3-Clause
// Over all ranks there may be 2^40 nodes; what one rank has is numbered in 32 bits.
#pragma once

#include <cstdint>
#include <string>

#include "base/error.hpp"

namespace pnpbs {

// With some room for what pads blocks.
inline constexpr std::int64_t kMaxOnRank = (std::int64_t{1} << 31) - 64;

inline void require_fits_rank(std::int64_t count, const char* name) {
  if (count <= kMaxOnRank) return;
  throw Error(ErrorKind::memory, "a rank would have " + std::to_string(count) + " " + name +
                                     ", and can have " + std::to_string(kMaxOnRank) +
                                     ": use more ranks");
}

}  // namespace pnpbs
