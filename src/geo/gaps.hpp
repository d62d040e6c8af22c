// SPDX-License-Identifier: BSD-3-Clause
// Cells without data in a rectangle, each of which takes the value of the nearest cell that has
// some: the fewest steps along columns and rows away, the first one row by row of several.
#pragma once

#include <cstdint>
#include <vector>

#include "geo/cell_box.hpp"

namespace pnpbs::geo {

class Gaps {
 public:
  // Values of the box, row by row: not a number where there is none.
  Gaps(const CellBox& box, const std::vector<double>& values);

  // Data of a cell outside of the box.
  void offer(std::int64_t column, std::int64_t row, double value);
  // After offers: so many steps beyond the box are cells which may be nearer to one of its gaps
  // than the nearest that is known, where all in `covered` are known; beyond `whole` there are
  // none. Returns 0 if none may be nearer, and no_end if no value is known.
  static constexpr std::int64_t no_end = std::int64_t{1} << 40;
  std::int64_t steps_beyond(const CellBox& covered, const CellBox& whole);
  std::vector<double> filled();

 private:
  struct Nearest {
    std::int64_t column, row;
    double value;
  };
  std::int64_t steps(const Nearest& from, std::int64_t column, std::int64_t row) const;
  void take_nearer(std::int64_t column, std::int64_t row, const Nearest& other);
  void spread();

  CellBox box_;
  std::vector<Nearest> nearest_;  // of each cell
  bool spread_ = false;
};

}  // namespace pnpbs::geo
