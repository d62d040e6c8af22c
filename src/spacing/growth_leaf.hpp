// SPDX-License-Identifier: BSD-3-Clause
// A leaf on which a spacing with limited growth is found, with what its samples of d tell.
#pragma once

#include "spacing/growth_source.hpp"
#include "spacing/line_of_sight.hpp"
#include "tree/leaf_cells.hpp"

namespace pnpbs {

template <int Dim>
struct GrowthLeaf {
  using Side = typename LineOfSight<Dim>::Side;

  LeafCell<Dim> cell;
  Side side = Side::crossed;
  bool open = true;          // to be split, perhaps
  bool fresh = true;         // no source has been looked for in it
  bool has_nodes = true;     // of the boundary, or fixed ones, or places
  bool probed = false;       // for dips of d between the samples
  bool sliver = false;       // do few of its samples lie in the domain?
  bool placed = false;       // is there a place in the domain that stands for it?
  Point<Dim> place{};        // its middle where that is inside
  GrowthSource<Dim> source;  // of the samples in it, the one that limits d there the most
  double min = 0, max = 0;   // of the samples
  double max_beside = 0;     // where the middles of leaves beside it would be, in space

  bool outside() const { return side == Side::outside; }
};

}  // namespace pnpbs
