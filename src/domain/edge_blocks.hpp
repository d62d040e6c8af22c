// SPDX-License-Identifier: BSD-3-Clause
// Boxes around blocks of consecutive boundary edges. Where a boundary is far finer than d a node
// has thousands of edges near it, and few of them lie on the way to another node: the others are
// passed over block by block.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "domain/segments.hpp"

namespace pnpbs {

class EdgeBlocks {
 public:
  // End(e, k) is end k of edge e.
  template <class End>
  void build(std::size_t edges, const End& end) {
    for (std::size_t l = 0; l < kSizes.size(); ++l) {
      boxes_[l].clear();
      for (std::size_t first = 0; first + kSizes[l] <= edges; first += kSizes[l]) {
        Box<2> box{end(first, 0), end(first, 0)};
        for (std::size_t e = first; e < first + kSizes[l]; ++e)
          for (const int side : {0, 1}) include(box, end(e, side));
        boxes_[l].push_back(with_room(box));
      }
    }
  }

  // Of a row of edges from place k on: how many make up a block that surely does not meet the way
  // from x to y? Usually none.
  std::size_t edges_off_the_way(std::span<const std::int32_t> row, std::size_t k, const Point<2>& x,
                                const Point<2>& y) const {
    for (std::size_t l = 0; l < kSizes.size(); ++l) {
      const auto first = static_cast<std::size_t>(row[k]);
      if (first % kSizes[l] != 0 || k + kSizes[l] > row.size()) continue;
      if (!is_block(row.subspan(k, kSizes[l]))) continue;
      if (!segment_may_meet_box(x, y, boxes_[l][first / kSizes[l]])) return kSizes[l];
    }
    return 0;
  }

 private:
  static constexpr std::array<std::size_t, 2> kSizes{256, 16};

  static bool is_block(std::span<const std::int32_t> edges) {
    bool consecutive = true;
    for (std::size_t e = 0; e < edges.size(); ++e)
      consecutive = consecutive & (edges[e] == edges[0] + static_cast<std::int32_t>(e));
    return consecutive;
  }

  static void include(Box<2>& box, const Point<2>& x) {
    for (std::size_t k = 0; k < 2; ++k) {
      box.low[k] = std::min(box.low[k], x[k]);
      box.high[k] = std::max(box.high[k], x[k]);
    }
  }

  // For the rounding of its middle.
  static Box<2> with_room(Box<2> box) {
    constexpr double kRounding = 8 * 0x1p-52;
    for (std::size_t k = 0; k < 2; ++k) {
      const double room = kRounding * (std::fabs(box.low[k]) + std::fabs(box.high[k]));
      box.low[k] -= room;
      box.high[k] += room;
    }
    return box;
  }

  std::array<std::vector<Box<2>>, kSizes.size()> boxes_;
};

}  // namespace pnpbs
