// SPDX-License-Identifier: BSD-3-Clause
#include "geo/raster_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace pnpbs::geo {

Gaps::Gaps(const CellBox& box, const std::vector<double>& values) : box_(box) {
  nearest_.reserve(values.size());
  for (std::int64_t row = box.row; row < box.row_end(); ++row)
    for (std::int64_t column = box.column; column < box.column_end(); ++column) {
      const double value = values[box.place_of(column, row)];
      // Cells without a known value start with a source far away.
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

// The shortest way from outside passes through the nearest cell of the box.
void Gaps::offer(std::int64_t column, std::int64_t row, double value) {
  take_nearer(std::clamp(column, box_.column, box_.column_end() - 1),
              std::clamp(row, box_.row, box_.row_end() - 1), {column, row, value});
  spread_ = false;
}

// Propagates nearest values in two sweeps, forth and back. Distances count steps along rows and
// columns, so some shortest way runs first along the column and then along the row.
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
      // Distance to the nearest cell that is not covered.
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

namespace {

// Columns and rows of the tiles in which gaps are filled. A tile takes a few milliseconds.
constexpr std::int64_t kTile = 256;

// Columns and rows that a tile shares with the next ones, so that every interval between cells lies
// inside one tile. Blocks share none, because blocks of the file would be decoded several times.
constexpr std::int64_t kShared = 1;

// The four cells around a point in row-major order. At the last column or row, the next one is the
// same.
struct Corners {
  std::int64_t column[2], row[2];
  Corners(const Between& place, const CellBox& window)
      : column{place.column, std::min(place.column + 1, window.column_end() - 1)},
        row{place.row, std::min(place.row + 1, window.row_end() - 1)} {}
};

// Interpolates. Returns NaN if a cell has no data.
double value_between(const Between& place, const std::array<double, 4>& corners) {
  // std::lerp(NaN, b, t) may return b.
  for (const double value : corners)
    if (std::isnan(value)) return value;
  return std::lerp(std::lerp(corners[0], corners[1], place.right),
                   std::lerp(corners[2], corners[3], place.right), place.down);
}

template <class Cells>
double value_between(const Between& place, const CellBox& window, const Cells& cells) {
  const auto& [column, row] = Corners(place, window);
  return value_between(place, {cells.at(column[0], row[0]), cells.at(column[1], row[0]),
                               cells.at(column[0], row[1]), cells.at(column[1], row[1])});
}

template <class Holds>
bool any_around(const Between& place, const CellBox& window, const Holds& holds) {
  const auto& [column, row] = Corners(place, window);
  return holds(column[0], row[0]) || holds(column[1], row[0]) || holds(column[0], row[1]) ||
         holds(column[1], row[1]);
}

// A request of point number `place` to a block or tile: its value, or the value of one of its
// corners if they lie in several blocks.
struct TileRequest {
  std::int64_t piece;
  std::size_t place;
  int corner;
  static constexpr int all = -1;
  bool operator<(const TileRequest& other) const { return piece < other.piece; }
};

CellBox grown(const CellBox& box, std::int64_t steps, const CellBox& whole) {
  return common_part(
      whole, {box.column - steps, box.row - steps, box.columns + 2 * steps, box.rows + 2 * steps});
}

// Returns the four parts of the outer box that surround the inner one.
std::vector<CellBox> frame_of(const CellBox& outer, const CellBox& inner) {
  return {{outer.column, outer.row, outer.columns, inner.row - outer.row},
          {outer.column, inner.row_end(), outer.columns, outer.row_end() - inner.row_end()},
          {outer.column, inner.row, inner.column - outer.column, inner.rows},
          {inner.column_end(), inner.row, outer.column_end() - inner.column_end(), inner.rows}};
}

}  // namespace

RasterValues::RasterValues(Read read, const CellBox& window, std::int64_t columns,
                           std::int64_t rows, const Memory& memory)
    : read_(std::move(read)),
      blocks_(window, columns, rows),
      tiles_(window, kTile, kTile),
      blocks_in_memory_(memory.blocks),
      tiles_in_memory_(memory.filled),
      tile_data_(static_cast<std::size_t>(tiles_.count()), Data::unknown) {}

const RasterBlock& RasterValues::block(std::int64_t number) {
  return blocks_in_memory_.get(number, [&] { return read_(blocks_.box_of(number)); });
}

// Calls take(column, row, value) for each cell with data, in row-major order within each block.
template <class Take>
void RasterValues::read_part(const CellBox& part, const Take& take) {
  blocks_.for_each_in(part, [&](std::int64_t number, const CellBox& cells) {
    const RasterBlock& its = block(number);
    for (std::int64_t row = cells.row; row < cells.row_end(); ++row)
      for (std::int64_t column = cells.column; column < cells.column_end(); ++column) {
        const double value = its.at(column, row);
        if (!std::isnan(value)) take(column, row, value);
      }
  });
}

// Searches from the middle block, where data are most likely.
bool RasterValues::has_data() {
  const std::int64_t count = blocks_.count();
  for (std::int64_t k = 0; k < count; ++k) {
    bool found = false;
    read_part(blocks_.box_of((count / 2 + k) % count), [&](auto...) { found = true; });
    if (found) return true;
  }
  return false;
}

bool RasterValues::tile_has_data(std::int64_t tile) {
  Data& data = tile_data_[static_cast<std::size_t>(tile)];
  if (data == Data::unknown) {
    data = Data::none;
    read_part(tiles_.box_of(tile), [&](auto...) { data = Data::some; });
  }
  return data == Data::some;
}

// Fills the gaps of a tile. Searches around it only as far as nearer data may exist.
RasterValues::Filled RasterValues::fill(std::int64_t tile) {
  const CellBox box = tiles_.box_of(tile, kShared), &whole = tiles_.whole();
  std::vector<double> own(static_cast<std::size_t>(box.count()), std::nan(""));
  read_part(box, [&](std::int64_t column, std::int64_t row, double value) {
    own[box.place_of(column, row)] = value;
  });
  std::vector<bool> has_data;
  for (const double value : own) has_data.push_back(!std::isnan(value));
  Gaps gaps(box, own);
  CellBox covered = box;
  for (std::int64_t ring = 1; covered != whole; ++ring) {
    const std::int64_t steps = gaps.steps_beyond(covered, whole);
    if (steps == 0) break;
    const CellBox wider = grown(box, std::min(steps, ring * kTile), whole);
    for (const CellBox& side : frame_of(wider, covered))
      tiles_.for_each_in(side, [&](std::int64_t there, const CellBox& cells) {
        if (tile_has_data(there)) read_part(cells, [&](auto... data) { gaps.offer(data...); });
      });
    covered = wider;
  }
  return {box, gaps.filled(), std::move(has_data)};
}

const RasterValues::Filled& RasterValues::filled(std::int64_t tile) {
  return tiles_in_memory_.get(tile, [&] { return fill(tile); });
}

void RasterValues::interpolate(const std::vector<Between>& places, double* values,
                               std::int32_t* has_data) {
  const CellBox& window = blocks_.whole();
  std::vector<TileRequest> requests;
  std::vector<std::size_t> apart;  // points with corners in several blocks
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& [column, row] = Corners(places[i], window);
    const std::int64_t first = blocks_.number_of(column[0], row[0]);
    if (first == blocks_.number_of(column[1], row[1])) {
      requests.push_back({first, i, TileRequest::all});
      continue;
    }
    for (int k = 0; k < 4; ++k)
      requests.push_back({blocks_.number_of(column[k % 2], row[k / 2]), apart.size(), k});
    apart.push_back(i);
  }
  if (blocks_.count() > 1) std::sort(requests.begin(), requests.end());
  std::vector<std::array<double, 4>> corners(apart.size());
  const RasterBlock* its = nullptr;
  for (std::size_t w = 0; w < requests.size(); ++w) {
    const auto& [number, i, corner] = requests[w];
    if (w == 0 || number != requests[w - 1].piece) its = &block(number);
    if (corner == TileRequest::all) {
      values[i] = value_between(places[i], window, *its);
    } else {
      const auto& [column, row] = Corners(places[apart[i]], window);
      corners[i][static_cast<std::size_t>(corner)] = its->at(column[corner % 2], row[corner / 2]);
    }
  }
  for (std::size_t k = 0; k < apart.size(); ++k)
    values[apart[k]] = value_between(places[apart[k]], corners[k]);
  interpolate_in_gaps(places, values, has_data);
}

// Computes the values that are still NaN, from tiles with filled gaps.
void RasterValues::interpolate_in_gaps(const std::vector<Between>& places, double* values,
                                       std::int32_t* has_data) {
  if (has_data) std::fill_n(has_data, places.size(), 1);
  std::vector<TileRequest> requests;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (std::isnan(values[i]))
      requests.push_back({tiles_.number_of(places[i].column, places[i].row), i, TileRequest::all});
  std::sort(requests.begin(), requests.end());
  for (const auto& [number, i, corner] : requests) {
    const Filled& tile = filled(number);
    values[i] = value_between(places[i], tiles_.whole(), tile);
    const auto holds = [&tile](std::int64_t column, std::int64_t row) {
      return tile.has_data[tile.cells.place_of(column, row)];
    };
    if (has_data) has_data[i] = any_around(places[i], tiles_.whole(), holds) ? 1 : 0;
  }
}

}  // namespace pnpbs::geo
