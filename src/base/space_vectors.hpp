// SPDX-License-Identifier: BSD-3-Clause
// Products of vectors in space.
#pragma once

#include "base/types.hpp"

namespace pnpbs {

inline Point<3> difference(const Point<3>& p, const Point<3>& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

inline Point<3> cross_product(const Point<3>& p, const Point<3>& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

inline double dot_product(const Point<3>& p, const Point<3>& q) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}

}  // namespace pnpbs
