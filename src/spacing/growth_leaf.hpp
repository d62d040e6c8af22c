// SPDX-License-Identifier: BSD-3-Clause
// A leaf of the tree that limits the growth of a spacing, with the results of sampling d in it.
#pragma once

#include "spacing/growth_source.hpp"
#include "spacing/line_of_sight.hpp"
#include "tree/leaf_cells.hpp"

namespace pnpbs {

// A leaf of the growth tree of one rank.
template <int Dim>
struct GrowthLeaf {
  using Side = typename LineOfSight<Dim>::Side;

  LeafCell<Dim> cell;
  Side side = Side::crossed;
  bool open = true;          // not yet decided whether it is split
  bool fresh = true;         // its samples have not been searched for a source yet
  bool has_nodes = true;     // contains boundary nodes, fixed nodes or given points
  bool probed = false;       // dips of d between its samples have been searched
  bool sliver = false;       // few of its samples lie in the domain
  bool placed = false;       // has a representative point in the domain
  Point<Dim> place{};        // representative point: the centre if that is inside
  GrowthSource<Dim> source;  // the sample that limits d at the representative point most
  double min = 0, max = 0;   // range of the samples of d
  double max_beside = 0;     // largest d at the centres of adjacent cells, in space only

  bool outside() const { return side == Side::outside; }
};

}  // namespace pnpbs
