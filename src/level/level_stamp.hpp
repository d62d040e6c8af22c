// SPDX-License-Identifier: BSD-3-Clause
// The stamp by which derived data recognize the state of a level that they belong to.
#pragma once

#include <cstdint>

namespace pnpbs {

// A stamp of a level's nodes and lists. Data that were derived at an equal stamp are valid.
// Different levels have different stamps.
struct LevelStamp {
  std::int64_t level = -1, version = -1;

  bool operator==(const LevelStamp&) const = default;
};

}  // namespace pnpbs
