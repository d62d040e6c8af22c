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
  double between = 0;  // no more may lie between the elements' boundary and the domain's

  double difference() const;
  bool agrees() const { return domain <= rounding || difference() <= rounding + between; }
  // It does not, and that is no small thing.
  bool far_off() const;
};

// After prepare_stars. Collective.
ElementMeasure measure_of_elements(const Results<3>& results);

// The same, or an empty one if the elements surely fill the domain but for a thousandth: that takes
// next to no time.
ElementMeasure measure_if_far_off(const Results<3>& results);

}  // namespace pnpbs
