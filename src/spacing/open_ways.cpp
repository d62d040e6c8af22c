// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/open_ways.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "domain/plane/edges.hpp"
#include "domain/volume/triangles.hpp"
#include "tree/cell_samples.hpp"

namespace pnpbs {

namespace {

template <int Dim>
Box<Dim> box_of(const Point<Dim>& a, const Point<Dim>& b) {
  Box<Dim> box;
  for (int k = 0; k < Dim; ++k) {
    box.low[k] = std::min(a[k], b[k]);
    box.high[k] = std::max(a[k], b[k]);
  }
  return box;
}

}  // namespace

template <int Dim>
OpenWays<Dim>::OpenWays(const Box<Dim>& bounds, double measure, BoundaryMesh<Dim> boundary)
    : bounds_(bounds), measure_(measure), boundary_(std::move(boundary)) {
  double wide = 0;
  for (int k = 0; k < Dim; ++k) wide = std::max(wide, bounds.high[k] - bounds.low[k]);
  const SpacingEvaluator<Dim> nothing_fine = [wide](std::int64_t n, const Point<Dim>*, double* d) {
    std::fill(d, d + n, wide);
  };
  map_.build(bounds_, boundary_, nothing_fine, {std::numeric_limits<std::int64_t>::max()});
}

template <int Dim>
typename OpenWays<Dim>::Side OpenWays<Dim>::side_of(const Box<Dim>& box) const {
  bool crossed = false;
  map_.tree().for_leaves_in(
      box, [&](std::int32_t) { return !crossed; },
      [&](std::int32_t leaf) {
        for (const std::int32_t f : map_.facets_of_leaf(leaf))
          crossed = crossed || may_meet_box(map_.corners(f), box);
      });
  if (crossed) return Side::crossed;
  return map_.inside(middle_of<Dim>(box)) ? Side::inside : Side::outside;
}

template <int Dim>
bool OpenWays<Dim>::open(const Point<Dim>& a, const Point<Dim>& b) const {
  bool open = true;
  const BackgroundTree<Dim>& tree = map_.tree();
  tree.for_leaves_in(
      box_of<Dim>(a, b),
      [&](std::int32_t cell) {
        return open && segment_may_meet_box(a, b, tree.cell_box_with_room(cell));
      },
      [&](std::int32_t leaf) { open = open && !map_.facet_between(leaf, a, b); });
  return open;
}

template class OpenWays<2>;
template class OpenWays<3>;

}  // namespace pnpbs
