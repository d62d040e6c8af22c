// SPDX-License-Identifier: BSD-3-Clause
// Initial inner nodes (section 2.1 of the paper): a lattice, in the plane of rhombic cells of 60
// and 120 degrees, in space of cubic cells. Where d varies, patches of the background tree over
// which it is nearly constant each have their own lattice, all of one orientation and anchored in
// one point.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "base/lattice.hpp"
#include "spacing/sized_tree.hpp"

namespace pnpbs {

// d in a cell of the tree, put together from its leaves.
template <int Dim>
struct SpacingSummary {
  double min = std::numeric_limits<double>::infinity();
  double max = 0;
  // Area or volume of the leaves in the domain, and their nodes in units of 1 per d^Dim.
  double measure = 0, nodes = 0;

  void add(const SpacingSummary& part);
  double spacing() const { return root<Dim>(measure / nodes); }
};

// What is known of a leaf at which the tree ends before it is fine enough.
template <int Dim>
struct LeafSummary {
  std::int32_t leaf;
  SpacingSummary<Dim> spacing;
};

// Of every cell of the tree, from the leaves up.
template <int Dim>
std::vector<SpacingSummary<Dim>> spacing_summaries(const SizedTree<Dim>& map,
                                                   const std::vector<LeafSummary<Dim>>& unrefined);

// Of the leaves for which wanted(leaf) holds and that are not steep, in their Morton order. In
// space the lattice is stretched to fit the domain's box, or else is as dense as d says.
template <int Dim>
std::vector<Point<Dim>> lattice_fill(const SizedTree<Dim>& map, const Box<Dim>& bounds,
                                     const std::function<bool(std::int32_t)>& wanted,
                                     const std::vector<LeafSummary<Dim>>& unrefined = {},
                                     bool stretched = true);

extern template struct SpacingSummary<2>;
extern template struct SpacingSummary<3>;
extern template std::vector<SpacingSummary<2>> spacing_summaries(
    const SizedTree<2>&, const std::vector<LeafSummary<2>>&);
extern template std::vector<SpacingSummary<3>> spacing_summaries(
    const SizedTree<3>&, const std::vector<LeafSummary<3>>&);
extern template std::vector<Point<2>> lattice_fill<2>(const SizedTree<2>&, const Box<2>&,
                                                      const std::function<bool(std::int32_t)>&,
                                                      const std::vector<LeafSummary<2>>&, bool);
extern template std::vector<Point<3>> lattice_fill<3>(const SizedTree<3>&, const Box<3>&,
                                                      const std::function<bool(std::int32_t)>&,
                                                      const std::vector<LeafSummary<3>>&, bool);

}  // namespace pnpbs
