// SPDX-License-Identifier: BSD-3-Clause
// Interpolated values of a raster of which only the recently used blocks are in memory. Cells
// without data take the value of the nearest cell with data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "geo/raster_block.hpp"

namespace pnpbs::geo {

// A cache of recently used values, limited by the sum of their bytes(), which their type must
// define.
template <class Value>
class RecentlyUsed {
 public:
  explicit RecentlyUsed(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  // Returns the value of this number, which is made by make() if it is not in the cache. The
  // reference is valid until the next call, even if the value alone exceeds the limit.
  template <class Make>
  const Value& get(std::int64_t number, const Make& make) {
    const auto found = places_.find(number);
    if (found != places_.end()) {
      values_.splice(values_.begin(), values_, found->second);
      return values_.front().second;
    }
    Value made = make();
    bytes_ += made.bytes();
    values_.emplace_front(number, std::move(made));
    places_[number] = values_.begin();
    while (bytes_ > most_bytes_ && values_.size() > 1) drop_last();
    return values_.front().second;
  }

 private:
  using Values = std::list<std::pair<std::int64_t, Value>>;

  void drop_last() {
    bytes_ -= values_.back().second.bytes();
    places_.erase(values_.back().first);
    values_.pop_back();
  }

  std::size_t most_bytes_, bytes_ = 0;
  Values values_;  // most recently used first
  std::unordered_map<std::int64_t, typename Values::iterator> places_;
};

// The cells of a rectangle in which cells without data take the value of the nearest cell with
// data. Distances count steps along columns and rows; of several nearest cells, the first in
// row-major order counts.
class Gaps {
 public:
  // Starts with the values of the box in row-major order, NaN for cells without data.
  Gaps(const CellBox& box, const std::vector<double>& values);

  // Adds the value of a cell outside the box.
  void offer(std::int64_t column, std::int64_t row, double value);
  // Returns the number of steps beyond the box within which a cell may be nearer to a gap than the
  // nearest known value. The cells in `covered` are known, and there are none outside `whole`.
  // Returns 0 if no cell may be nearer, and no_end if no value is known.
  static constexpr std::int64_t no_end = std::int64_t{1} << 40;
  std::int64_t steps_beyond(const CellBox& covered, const CellBox& whole);
  // Returns the values of the box with filled gaps.
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
  std::vector<Nearest> nearest_;  // by cell of the box
  bool spread_ = false;
};

// A point between the centres of a cell and of the next column and row. `right` and `down` are
// fractions of the distance.
struct Between {
  std::int64_t column, row;
  double right, down;
};

// Interpolated values of a raster window.
class RasterValues {
 public:
  using Read = std::function<RasterBlock(const CellBox&)>;
  struct Memory {  // largest sizes. [bytes]
    std::size_t blocks = std::size_t{192} << 20, filled = std::size_t{64} << 20;
  };

  // Creates the values of the cells in `window`. `columns` and `rows` are the size of blocks to
  // read.
  RasterValues(Read read, const CellBox& window, std::int64_t columns, std::int64_t rows,
               const Memory& memory);

  bool has_data();  // returns whether any cell has data; reads until it finds one
  // Interpolates bilinearly, constant beyond the centres of the outermost cells. Reads each block
  // at most once, except for filling gaps. has_data[i] is 0 if none of the cells around the point
  // has data, else 1; `has_data` may be null.
  void interpolate(const std::vector<Between>& places, double* values,
                   std::int32_t* has_data = nullptr);

 private:
  struct Filled {
    CellBox cells;
    std::vector<double> values;
    std::vector<bool> has_data;
    std::size_t bytes() const { return values.size() * sizeof(double) + has_data.size() / 8; }
    double at(std::int64_t column, std::int64_t row) const {
      return values[cells.place_of(column, row)];
    }
  };
  enum class Data : char { unknown, none, some };

  void interpolate_in_gaps(const std::vector<Between>& places, double* values,
                           std::int32_t* has_data);
  const RasterBlock& block(std::int64_t number);
  const Filled& filled(std::int64_t tile);
  Filled fill(std::int64_t tile);
  bool tile_has_data(std::int64_t tile);
  template <class Take>
  void read_part(const CellBox& part, const Take& take);

  Read read_;
  Tiling blocks_, tiles_;  // division into units of reading, and of filling gaps
  RecentlyUsed<RasterBlock> blocks_in_memory_;
  RecentlyUsed<Filled> tiles_in_memory_;
  std::vector<Data> tile_data_;
};

}  // namespace pnpbs::geo
