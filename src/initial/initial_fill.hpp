// SPDX-License-Identifier: BSD-3-Clause
// Places initial inner nodes (section 2.1 of the paper) on a lattice: rhombic cells of 60 and 120
// degrees in the plane, cubic cells in space. Where d varies, each patch of the background tree in
// which d is nearly constant has its own lattice. All lattices have the same orientation and
// origin.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "base/lattice.hpp"
#include "spacing/sized_tree.hpp"

namespace pnpbs {

// The spacing in a cell of the tree, accumulated over its leaves.
template <int Dim>
struct SpacingSummary {
  double min = std::numeric_limits<double>::infinity();
  double max = 0;
  // Area or volume of the leaves in the domain, and the number of nodes there in units of 1 per
  // d^Dim.
  double measure = 0, nodes = 0;

  void add(const SpacingSummary& part);
  // Returns the constant spacing that gives the same number of nodes.
  double spacing() const { return root<Dim>(measure / nodes); }
};

// The spacing in a leaf that only other ranks have refined.
template <int Dim>
struct LeafSummary {
  std::int32_t leaf;
  SpacingSummary<Dim> spacing;
};

// Returns the summaries of all cells of the tree, accumulated from the leaves upwards.
template <int Dim>
std::vector<SpacingSummary<Dim>> spacing_summaries(const SizedTree<Dim>& map,
                                                   const std::vector<LeafSummary<Dim>>& unrefined);

// Returns lattice nodes in the leaves for which wanted(leaf) is true and in which d does not vary
// too much, in Morton order of the leaves. In space, a single lattice is stretched to fit `bounds`
// if `stretched`, else it has exactly the density that d requires.
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
