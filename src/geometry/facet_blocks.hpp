// SPDX-License-Identifier: BSD-3-Clause
// Boxes around blocks of consecutive facets. Where a boundary is far finer than d a node has
// thousands of facets near it, and few of them lie on the way to another node: the others are
// passed over block by block.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/plane/edges.hpp"
#include "geometry/volume/triangles.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

template <int Dim>
class FacetBlocks {
 public:
  void build(std::span<const FacetCorners<Dim>> facets) {
    for (std::size_t l = 0; l < kSizes.size(); ++l) {
      boxes_[l].clear();
      for (std::size_t first = 0; first + kSizes[l] <= facets.size(); first += kSizes[l])
        boxes_[l].push_back(with_room(box_around(facets.subspan(first, kSizes[l]))));
    }
  }

  // Of a row of facets from place k on: how many make up a block that surely does not meet the way
  // from x to y? Usually none.
  std::size_t facets_off_segment(std::span<const std::int32_t> row, std::size_t k,
                                 const Point<Dim>& x, const Point<Dim>& y) const {
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

  static bool is_block(std::span<const std::int32_t> facets) {
    bool consecutive = true;
    for (std::size_t f = 0; f < facets.size(); ++f)
      consecutive = consecutive & (facets[f] == facets[0] + static_cast<std::int32_t>(f));
    return consecutive;
  }

  static Box<Dim> box_around(std::span<const FacetCorners<Dim>> facets) {
    Box<Dim> box{facets[0][0], facets[0][0]};
    for (const FacetCorners<Dim>& corners : facets)
      for (const Point<Dim>& x : corners) box = joined(box, {x, x});
    return box;
  }

  // For the rounding of its middle.
  static Box<Dim> with_room(Box<Dim> box) {
    constexpr double kRounding = 8 * 0x1p-52;
    for (std::size_t k = 0; k < Dim; ++k) {
      const double room = kRounding * (std::fabs(box.low[k]) + std::fabs(box.high[k]));
      box.low[k] -= room;
      box.high[k] += room;
    }
    return box;
  }

  std::array<std::vector<Box<Dim>>, kSizes.size()> boxes_;
};

}  // namespace pnpbs
