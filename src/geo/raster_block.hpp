// SPDX-License-Identifier: BSD-3-Clause
// Rectangles of raster cells, and their values in the smallest type that represents them exactly.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <variant>
#include <vector>

namespace pnpbs::geo {

// A rectangle of cells.
struct CellBox {
  std::int64_t column, row, columns, rows;

  std::int64_t count() const { return columns * rows; }
  std::int64_t column_end() const { return column + columns; }
  std::int64_t row_end() const { return row + rows; }
  // Returns the index of a cell in row-major order.
  std::size_t place_of(std::int64_t its_column, std::int64_t its_row) const {
    return static_cast<std::size_t>((its_row - row) * columns + (its_column - column));
  }
  bool operator==(const CellBox&) const = default;
};

// Returns the intersection, which has no columns or no rows if it is empty.
inline CellBox common_part(const CellBox& a, const CellBox& b) {
  const std::int64_t column = std::max(a.column, b.column), row = std::max(a.row, b.row);
  return {column, row, std::max<std::int64_t>(0, std::min(a.column_end(), b.column_end()) - column),
          std::max<std::int64_t>(0, std::min(a.row_end(), b.row_end()) - row)};
}

// A division of a rectangle into tiles. Tiles begin at multiples of their size and are cut at the
// edges of the rectangle.
class Tiling {
 public:
  Tiling(const CellBox& whole, std::int64_t columns, std::int64_t rows)
      : whole_(whole),
        columns_(columns),
        rows_(rows),
        first_column_(whole.column / columns),
        first_row_(whole.row / rows),
        across_((whole.column_end() - 1) / columns - first_column_ + 1),
        down_((whole.row_end() - 1) / rows - first_row_ + 1) {}

  const CellBox& whole() const { return whole_; }
  std::int64_t count() const { return across_ * down_; }
  std::int64_t number_of(std::int64_t column, std::int64_t row) const {
    return (row / rows_ - first_row_) * across_ + (column / columns_ - first_column_);
  }
  // Returns the cells of a tile, and `more` columns and rows of those that follow.
  CellBox box_of(std::int64_t number, std::int64_t more = 0) const {
    return common_part(whole_,
                       {(number % across_ + first_column_) * columns_,
                        (number / across_ + first_row_) * rows_, columns_ + more, rows_ + more});
  }
  // Calls call(tile, its cells in the box) for each tile that meets the box.
  template <class Call>
  void for_each_in(const CellBox& box, const Call& call) const {
    const CellBox part = common_part(whole_, box);
    if (part.count() == 0) return;
    const std::int64_t first = number_of(part.column, part.row),
                       last = number_of(part.column_end() - 1, part.row_end() - 1);
    for (std::int64_t row = first / across_; row <= last / across_; ++row)
      for (std::int64_t column = first % across_; column <= last % across_; ++column) {
        const std::int64_t number = row * across_ + column;
        call(number, common_part(part, box_of(number)));
      }
  }

 private:
  CellBox whole_;
  std::int64_t columns_, rows_, first_column_, first_row_, across_, down_;
};

// Conversion of the numbers in a file to values.
struct NumberConversion {
  bool has_no_data = false;
  double no_data = 0;
  double scale = 1, offset = 0;

  // Returns the value, or NaN if there is no data.
  double value(double number) const {
    if ((has_no_data && number == no_data) || !std::isfinite(number))
      return std::numeric_limits<double>::quiet_NaN();
    return scale * number + offset;
  }
};

// The values of a rectangle of cells.
struct RasterBlock {
  using Numbers = std::variant<std::vector<std::int16_t>, std::vector<float>, std::vector<double>>;

  CellBox cells;
  Numbers numbers;  // in row-major order
  NumberConversion meaning;

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
