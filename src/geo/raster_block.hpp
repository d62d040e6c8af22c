// SPDX-License-Identifier: BSD-3-Clause
// A rectangle of a raster's values, in the least type that has them exactly.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <variant>
#include <vector>

#include "geo/cell_box.hpp"

namespace pnpbs::geo {

// What numbers in a file stand for.
struct RasterMeaning {
  bool has_no_data = false;
  double no_data = 0;
  double scale = 1, offset = 0;

  // Not a number where there is no data.
  double value(double number) const {
    if ((has_no_data && number == no_data) || !std::isfinite(number))
      return std::numeric_limits<double>::quiet_NaN();
    return scale * number + offset;
  }
};

struct RasterBlock {
  using Numbers = std::variant<std::vector<std::int16_t>, std::vector<float>, std::vector<double>>;

  CellBox cells;
  Numbers numbers;  // row by row
  RasterMeaning meaning;

  double at(std::int64_t column, std::int64_t row) const {
    const std::size_t place = cells.place_of(column, row);
    return std::visit(
        [&](const auto& numbers) { return meaning.value(static_cast<double>(numbers[place])); },
        numbers);
  }
  std::size_t bytes() const {
    return std::visit([](const auto& numbers) { return numbers.size() * sizeof(numbers[0]); },
                      numbers);
  }
};

}  // namespace pnpbs::geo
