// SPDX-License-Identifier: BSD-3-Clause
// Conformity of the elements: whether they fill the domain, as far as this can be determined
// reliably. It decides the outcome and the warning at the end of a run and is part of the check of
// results.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "base/message_text.hpp"
#include "check/boundary_topology.hpp"
#include "check/element_measure.hpp"
#include "check/region_measure.hpp"
#include "level/found_nodes.hpp"
#include "results/results.hpp"

namespace pnpbs {

// A measure of how far the elements are from filling the domain. Of two rounds, the one with the
// smaller value is better; members are compared in the order of their declaration.
struct ElementFaults {
  bool no_elements = false;
  std::int64_t pieces = 0;            // surplus or missing pieces of the boundary
  std::int64_t euler = 0;             // error of its Euler characteristic
  std::int64_t lost_thousandths = 0;  // error of the volume, in thousandths
  std::int64_t torn = 0;              // nodes in no element or at a torn boundary; flat elements
  // Error of the volumes of regions, in thousandths of each, and of the area of inner surfaces.
  std::int64_t crossed_thousandths = 0;

  auto operator<=>(const ElementFaults&) const = default;
};

// The faults that decide whether the elements conform. Counts are over all ranks.
template <int Dim>
struct Conformity {
  static constexpr double kMinInnerShare = 0.9;

  std::int64_t nodes = 0;     // all nodes
  FoundNodes<Dim> isolated;   // nodes in no element
  FoundNodes<Dim> unmatched;  // surfaces alone: edges whose number of triangles differs
                              // from the number of sheets; found at the end with the smaller id
  ElementMeasure measure;     // space: set only if the volume may be far off
  BoundaryTopology boundary;  // bodies only
  FoundNodes<Dim> flat;       // bodies only: elements of volume 0
  std::vector<RegionMeasure> regions;  // bodies only: those far off their volume
  double inner_share = 1;              // bodies only: share of the inner surfaces that faces follow
  // Points of this rank where elements are missing: nodes in no element, unmatched edges, nodes at
  // a torn boundary, and corners of flat elements.
  std::vector<Point<Dim>> torn;

  bool any_elements() const { return isolated.count < nodes; }
  bool fills() const {
    return any_elements() && isolated.count == 0 && unmatched.count == 0 && flat.count == 0 &&
           !measure.far_off();
  }
  // Returns the number of nodes, edges or elements that text_of reports, or 0 if it reports none.
  std::int64_t faults() const {
    if (!any_elements()) return 0;
    for (const std::int64_t count : {isolated.count, unmatched.count, flat.count})
      if (count > 0) return count;
    return measure.far_off() ? 0 : boundary.torn.count;
  }
  // Returns whether faces follow the inner surfaces.
  bool divides() const { return regions.empty() && inner_share >= kMinInnerShare; }
  bool holds() const { return fills() && boundary.agrees() && divides(); }
  ElementFaults element_faults() const;
};

// Determines the conformity. Requires prepare_stars(). Collective.
template <int Dim>
Conformity<Dim> conformity_of(const Results<Dim>& results);

// Returns whether tetrahedra cross inner surfaces, so that these do not divide the elements.
// Requires prepare_stars(). Collective.
template <int Dim>
bool crosses_inner_surfaces(const Results<Dim>& results);

// Returns a message about the first fault, with a point, or an empty text if the elements conform.
// Collective.
template <int Dim>
MessageText text_of(const Conformity<Dim>& conformity, const Results<Dim>& results);

}  // namespace pnpbs
