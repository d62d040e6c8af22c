// SPDX-License-Identifier: BSD-3-Clause
// Checks of the size of a domain and of its distance from the origin. The size is the longest side
// of the bounding box.
#pragma once

#include <cmath>

#include "base/error.hpp"
#include "base/limits.hpp"
#include "base/point_text.hpp"

namespace pnpbs {

// Throws Error(ErrorKind::domain) if the domain is smaller than kSmallestDomain.
inline void require_domain_size(double size) {
  if (size < kSmallestDomain)
    reject_domain("the domain's size is " + number_text(size) + ", less than " +
                  number_text(kSmallestDomain));
}

// Throws Error(ErrorKind::domain) if the domain is so far from the origin for its size that its
// coordinates have too few significant digits.
template <int Dim>
void require_near_origin(double size, const Point<Dim>& x) {
  for (const double coordinate : x)
    if (size < kSmallestRelativeSize * std::fabs(coordinate))
      reject_domain("the domain's size is " + number_text(size) + ", less than " +
                    number_text(kSmallestRelativeSize) +
                    " of its distance from the origin, as at " + point_text(x) +
                    ": move the domain closer to the origin");
}

}  // namespace pnpbs
