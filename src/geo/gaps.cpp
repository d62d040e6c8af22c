// SPDX-License-Identifier: BSD-3-Clause
#include "geo/gaps.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace pnpbs::geo {

Gaps::Gaps(const CellBox& box, const std::vector<double>& values) : box_(box) {
  nearest_.reserve(values.size());
  for (std::int64_t row = box.row; row < box.row_end(); ++row)
    for (std::int64_t column = box.column; column < box.column_end(); ++column) {
      const double value = values[box.place_of(column, row)];
      // What nobody knows is far off.
      nearest_.push_back({column, std::isnan(value) ? row + no_end : row, value});
    }
}

std::int64_t Gaps::steps(const Nearest& from, std::int64_t column, std::int64_t row) const {
  return std::abs(from.column - column) + std::abs(from.row - row);
}

void Gaps::take_nearer(std::int64_t column, std::int64_t row, const Nearest& other) {
  Nearest& own = nearest_[box_.place_of(column, row)];
  const std::int64_t its = steps(other, column, row), now = steps(own, column, row);
  const bool first = other.row < own.row || (other.row == own.row && other.column < own.column);
  if (its < now || (its == now && first)) own = other;
}

// The way from outside leads over the cell of the box next to it.
void Gaps::offer(std::int64_t column, std::int64_t row, double value) {
  take_nearer(std::clamp(column, box_.column, box_.column_end() - 1),
              std::clamp(row, box_.row, box_.row_end() - 1), {column, row, value});
  spread_ = false;
}

// From cell to cell, there and back. A way of fewest steps may go along its column first and then
// along its row, and on it a cell has either the nearest of the last one or a nearer one.
void Gaps::spread() {
  if (spread_) return;
  spread_ = true;
  const std::int64_t columns = box_.columns, rows = box_.rows;
  const auto visit = [&](std::int64_t i, std::int64_t j, std::int64_t from_i, std::int64_t from_j) {
    if (from_i < 0 || from_j < 0 || from_i == columns || from_j == rows) return;
    const Nearest other = nearest_[static_cast<std::size_t>(from_j * columns + from_i)];
    if (!std::isnan(other.value)) take_nearer(box_.column + i, box_.row + j, other);
  };
  for (std::int64_t j = 0; j < rows; ++j)
    for (std::int64_t i = 0; i < columns; ++i) visit(i, j, i - 1, j), visit(i, j, i, j - 1);
  for (std::int64_t j = rows; j-- > 0;)
    for (std::int64_t i = columns; i-- > 0;) visit(i, j, i + 1, j), visit(i, j, i, j + 1);
}

std::int64_t Gaps::steps_beyond(const CellBox& covered, const CellBox& whole) {
  spread();
  const std::int64_t to_west = covered.column > whole.column ? covered.column : -no_end,
                     to_north = covered.row > whole.row ? covered.row : -no_end,
                     to_east =
                         covered.column_end() < whole.column_end() ? covered.column_end() : no_end,
                     to_south = covered.row_end() < whole.row_end() ? covered.row_end() : no_end;
  std::int64_t most = 0;
  for (std::int64_t row = box_.row; row < box_.row_end(); ++row)
    for (std::int64_t column = box_.column; column < box_.column_end(); ++column) {
      const std::int64_t now = steps(nearest_[box_.place_of(column, row)], column, row);
      // To the nearest cell that is not covered.
      const std::int64_t out =
          std::min({column - to_west + 1, to_east - column, row - to_north + 1, to_south - row});
      if (now >= out) most = std::max(most, now);
    }
  return std::min(most, no_end);
}

std::vector<double> Gaps::filled() {
  spread();
  std::vector<double> values;
  values.reserve(nearest_.size());
  for (const Nearest& each : nearest_) values.push_back(each.value);
  return values;
}

}  // namespace pnpbs::geo
