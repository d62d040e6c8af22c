// SPDX-License-Identifier: BSD-3-Clause
// Comparison of the volume or area of the elements in space with that of the domain.
#pragma once

#include "results/results.hpp"

namespace pnpbs {

// Volumes, or areas for surfaces alone, over all ranks.
struct ElementMeasure {
  double elements = 0, domain = 0;
  double enclosed = 0;  // volume enclosed by the boundary of the tetrahedra
  double rounding = 0;
  double between = 0;  // upper bound of what lies between boundary faces and surfaces
  // For bodies, an estimate of the volume between the surfaces and the boundary faces, which are
  // chords of them. It follows from the distances at the midpoints of the faces' edges and is
  // positive outside the faces. The second value is the sum of the absolute contributions.
  double chord_error = 0, absolute_chord_error = 0;

  double difference() const;
  bool agrees() const { return domain <= rounding || difference() <= rounding + between; }
  // Returns true if the elements miss or exceed more than a thousandth of the domain after
  // correction for the chord error.
  bool far_off() const;
};

// Returns the volume of the tetrahedra of a body, or 0 for other kinds of domains. Requires
// prepare_stars(). Collective.
double volume_of_elements(const Results<2>& results);
double volume_of_elements(const Results<3>& results);

// Returns all measures. Requires prepare_stars(). Collective.
ElementMeasure measure_of_elements(const Results<3>& results);

// Returns the same, or an empty measure if the elements fill the domain up to a thousandth, which
// takes hardly any time.
ElementMeasure measure_if_far_off(const Results<3>& results);

}  // namespace pnpbs
