// SPDX-License-Identifier: BSD-3-Clause
// What the elements of a placement in space fill, against the domain.
#pragma once

#include "results/results.hpp"

namespace pnpbs {

// Volumes, of surfaces alone areas; over all ranks.
struct ElementMeasure {
  double elements = 0, domain = 0;
  double enclosed = 0;  // by the boundary of the tetrahedra
  double rounding = 0;
  double between = 0;  // no more can lie between the boundary faces and the surfaces
  // Of a body, what lies between its surfaces and the boundary faces, which are chords of them:
  // from the distances at the middles of the faces' sides; positive outside the faces; and the sum
  // of its absolute values.
  double chord_error = 0, absolute_chord_error = 0;

  double difference() const;
  bool agrees() const { return domain <= rounding || difference() <= rounding + between; }
  // Is more than a thousandth of the domain lost, or filled in excess, that is no chord error?
  bool far_off() const;
};

// What the tetrahedra fill alone, of a body; 0 of other kinds of domains. After prepare_stars.
// Collective.
double volume_of_elements(const Results<2>& results);
double volume_of_elements(const Results<3>& results);

// After prepare_stars. Collective.
ElementMeasure measure_of_elements(const Results<3>& results);

// The same, or an empty one if the elements surely fill the domain but for a thousandth: that takes
// next to no time.
ElementMeasure measure_if_far_off(const Results<3>& results);

}  // namespace pnpbs
