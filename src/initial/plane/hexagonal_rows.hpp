// SPDX-License-Identifier: BSD-3-Clause
// The lattice that fills the plane: rows of nodes d apart, every second one shifted by half a step.
#pragma once

#include <cmath>
#include <cstdint>

#include "base/types.hpp"

namespace pnpbs {

class HexagonalRows {
 public:
  // Anchored in the corner of the box. One lattice for the whole domain is stretched a little so
  // that rows end on its box.
  HexagonalRows(double d, const Box<2>& bounds, bool whole)
      : low_(bounds.low), step_(d), row_(d * std::sqrt(0.75)) {
    if (!whole) return;
    step_ = fitted(step_, bounds.high[0] - bounds.low[0]);
    row_ = fitted(row_, bounds.high[1] - bounds.low[1]);
  }

  // Calls visit(x) for all nodes in the box, and some next to it.
  template <class Visit>
  void for_nodes(const Box<2>& box, const Visit& visit) const {
    const auto first_row = static_cast<std::int64_t>(std::ceil((box.low[1] - low_[1]) / row_)) - 1;
    for (std::int64_t row = first_row;; ++row) {
      const double y = low_[1] + row_ * static_cast<double>(row);
      if (y >= box.high[1] + 0.5 * row_) break;
      const double shift = low_[0] + (row % 2 != 0 ? 0.5 * step_ : 0.0);
      auto column = static_cast<std::int64_t>(std::ceil((box.low[0] - shift) / step_)) - 1;
      for (;; ++column) {
        const Point<2> x{shift + step_ * static_cast<double>(column), y};
        if (x[0] >= box.high[0] + 0.5 * step_) break;
        visit(x);
      }
    }
  }

 private:
  static double fitted(double step, double extent) {
    const double steps = std::round(extent / step);
    return steps >= 8 ? extent / steps : step;
  }

  Point<2> low_;
  double step_;  // between nodes of a row
  double row_;   // between rows
};

}  // namespace pnpbs
