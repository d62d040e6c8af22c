// SPDX-License-Identifier: BSD-3-Clause
// Values between the cells of a raster, of which no more than some blocks are in memory: those
// used last. Cells without data have the value of the nearest cell that has some.
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

// Values have bytes().
template <class Value>
class RecentlyUsed {
 public:
  explicit RecentlyUsed(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  // The value of this number, made if it is not there. It is there until the next call, even where
  // it alone has more bytes than all may have.
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
  Values values_;  // the last used first
  std::unordered_map<std::int64_t, typename Values::iterator> places_;
};

// Cells without data in a rectangle, each of which takes the value of the nearest cell that has
// some: the fewest steps along columns and rows away, the first one row by row of several.
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

// Between the middles of a cell and of the next ones, by these parts of the way.
struct Between {
  std::int64_t column, row;
  double right, down;
};

class RasterValues {
 public:
  using Read = std::function<RasterBlock(const CellBox&)>;
  struct Memory {  // bytes, at most
    std::size_t blocks = std::size_t{192} << 20, filled = std::size_t{64} << 20;
  };

  // Of the cells in a window, read in blocks of this many columns and rows.
  RasterValues(Read read, const CellBox& window, std::int64_t columns, std::int64_t rows,
               const Memory& memory);

  bool has_data();  // at all: reads until there is some
  // Linear in each direction; constant beyond the middles of the last cells. Each block is read
  // once at most, but where cells without data ask for others. has_data[i], unless nullptr, is 0
  // where none of the cells around a place has data, else 1.
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
  Tiling blocks_, tiles_;  // what is read at once, and filled at once
  RecentlyUsed<RasterBlock> blocks_in_memory_;
  RecentlyUsed<Filled> tiles_in_memory_;
  std::vector<Data> tile_data_;
};

}  // namespace pnpbs::geo
