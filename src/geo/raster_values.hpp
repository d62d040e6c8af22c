// SPDX-License-Identifier: BSD-3-Clause
// Values between the cells of a raster, of which no more than some blocks are in memory: those
// used last. Cells without data have the value of the nearest cell that has some.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "geo/cell_box.hpp"
#include "geo/raster_block.hpp"
#include "geo/recently_used.hpp"

namespace pnpbs::geo {

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
