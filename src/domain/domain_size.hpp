// SPDX-License-Identifier: BSD-3-Clause
// How small a domain may be, and how far from the origin. Its size is the longest side of its
// bounding box.
#pragma once

#include <cmath>

#include "base/error.hpp"
#include "base/limits.hpp"
#include "base/point_text.hpp"

namespace pnpbs {

inline void require_domain_size(double size) {
  if (size < kSmallestDomain)
    reject_domain("the domain's size is " + number_text(size) + ", less than " +
                  number_text(kSmallestDomain));
}

// Of a small domain far from the origin the coordinates have too few digits left.
template <int Dim>
void require_near_origin(double size, const Point<Dim>& x) {
  for (const double coordinate : x)
    if (size < kSmallestRelativeSize * std::fabs(coordinate))
      reject_domain("the domain's size is " + number_text(size) + ", less than " +
                    number_text(kSmallestRelativeSize) +
                    " of its distance from the origin, as at " + point_text(x) +
                    ": move it nearer");
}

}  // namespace pnpbs
