// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/open_ways.hpp"

#include <algorithm>
#include <limits>

#include "domain/plane/edges.hpp"

namespace pnpbs {

namespace {

Point<2> middle_of(const Box<2>& box) {
  return {0.5 * (box.low[0] + box.high[0]), 0.5 * (box.low[1] + box.high[1])};
}

Box<2> box_of(const Point<2>& a, const Point<2>& b) {
  return {{std::min(a[0], b[0]), std::min(a[1], b[1])},
          {std::max(a[0], b[0]), std::max(a[1], b[1])}};
}

}  // namespace

OpenWays<2>::OpenWays(const PlaneDomain& domain, const SpacingEvaluator<2>& spacing,
                      std::int64_t most_nodes)
    : bounds_(domain.bounds()), area_(domain.area()) {
  boundary_ = discretize_boundary(domain, spacing, most_nodes);
  const double wide = std::max(bounds_.high[0] - bounds_.low[0], bounds_.high[1] - bounds_.low[1]);
  const SpacingEvaluator<2> nothing_fine = [wide](std::int64_t n, const Point<2>*, double* d) {
    std::fill(d, d + n, wide);
  };
  map_.build(bounds_, boundary_, nothing_fine, std::numeric_limits<std::int64_t>::max());
}

OpenWays<2>::Side OpenWays<2>::side_of(const Box<2>& box) const {
  bool crossed = false;
  map_.tree().for_leaves_in(
      box, [&](std::int32_t) { return !crossed; },
      [&](std::int32_t leaf) {
        for (const std::int32_t e : map_.facets_of_leaf(leaf))
          crossed = crossed || may_meet_box(map_.corners(e), box);
      });
  if (crossed) return Side::crossed;
  return map_.inside(middle_of(box)) ? Side::inside : Side::outside;
}

bool OpenWays<2>::open(const Point<2>& a, const Point<2>& b) const {
  bool open = true;
  const BackgroundTree<2>& tree = map_.tree();
  tree.for_leaves_in(
      box_of(a, b),
      [&](std::int32_t cell) {
        return open && segment_may_meet_box(a, b, tree.cell_box_with_room(cell));
      },
      [&](std::int32_t leaf) { open = open && !map_.facet_between(leaf, a, b); });
  return open;
}

}  // namespace pnpbs
