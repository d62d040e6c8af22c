// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace pnpbs {

// Of a level's nodes and lists: as long as it is the same, what was found of them holds. Levels
// have different ones.
struct LevelStamp {
  std::int64_t level = -1, version = -1;

  bool operator==(const LevelStamp&) const = default;
};

}  // namespace pnpbs
