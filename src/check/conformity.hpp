// SPDX-License-Identifier: BSD-3-Clause
// Do the elements fill the domain? What can be told of that for certain: the same at the end of a
// run, for its outcome and its warning, and by the check of the results.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "base/message_text.hpp"
#include "check/boundary_topology.hpp"
#include "check/element_measure.hpp"
#include "level/found_nodes.hpp"
#include "results/results.hpp"

namespace pnpbs {

// How far the elements are from filling the domain. Of two rounds of a run the one with fewer
// faults is better: what is named first counts first.
struct ElementFaults {
  bool no_elements = false;
  std::int64_t pieces = 0;            // of the boundary, too many or too few
  std::int64_t euler = 0;             // by which its Euler characteristic is off
  std::int64_t lost_thousandths = 0;  // of the volume, by which it is off
  std::int64_t torn = 0;  // nodes in no element, or where the boundary is torn; flat elements

  auto operator<=>(const ElementFaults&) const = default;
};

template <int Dim>
struct Conformity {
  std::int64_t nodes = 0;     // over all ranks, as all here
  FoundNodes<Dim> isolated;   // nodes in no element
  FoundNodes<Dim> unmatched;  // edges of surfaces alone with more or fewer triangles than sheets
                              // meet there; found at the end that has the lesser id
  ElementMeasure measure;     // in space, if what the elements fill may be far off
  BoundaryTopology boundary;  // of bodies
  FoundNodes<Dim> flat;       // of bodies: elements without a volume
  // This rank's places where elements are lacking: nodes in none, edges that do not join, where the
  // boundary is torn, and corners of elements without a volume.
  std::vector<Point<Dim>> torn;

  bool any_elements() const { return isolated.count < nodes; }
  bool fills() const {
    return any_elements() && isolated.count == 0 && unmatched.count == 0 && flat.count == 0 &&
           !measure.far_off();
  }
  // Nodes, edges or elements that text_of counts; 0 if it counts none.
  std::int64_t faults() const {
    if (!any_elements()) return 0;
    for (const std::int64_t count : {isolated.count, unmatched.count, flat.count})
      if (count > 0) return count;
    return measure.far_off() ? 0 : boundary.torn.count;
  }
  bool holds() const { return fills() && boundary.agrees(); }
  ElementFaults element_faults() const;
};

// After prepare_stars. Collective.
template <int Dim>
Conformity<Dim> conformity_of(const Results<Dim>& results);

// What is wrong, with places; empty if nothing is. Collective.
template <int Dim>
MessageText text_of(const Conformity<Dim>& conformity, const Results<Dim>& results);

}  // namespace pnpbs
