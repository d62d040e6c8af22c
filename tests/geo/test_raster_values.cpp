// SPDX-License-Identifier: BSD-3-Clause
// Tests values between the cells of a raster that keeps only some blocks in memory, against a
// raster that is completely in memory. They are equal to the bit for any size of the memory.
#include <cmath>
#include <cstring>
#include <deque>
#include <limits>
#include <map>
#include <random>
#include <vector>

#include "check_runner.h"
#include "geo/raster_values.hpp"

using namespace pnpbs::geo;

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

struct Whole {
  CellBox cells;
  std::vector<double> values;
  double at(std::int64_t column, std::int64_t row) const {
    return values[cells.place_of(column, row)];
  }
};

// Fills cells without data: spreads values from the cells that have one, step by step.
void fill_all(Whole& whole) {
  std::deque<std::int64_t> front;
  const std::int64_t columns = whole.cells.columns, count = whole.cells.count();
  for (std::int64_t i = 0; i < count; ++i)
    if (!std::isnan(whole.values[i])) front.push_back(i);
  for (; !front.empty(); front.pop_front()) {
    const std::int64_t from = front[0], column = from % columns;
    const auto visit = [&](bool exists, std::int64_t to) {
      if (!exists || !std::isnan(whole.values[to])) return;
      whole.values[to] = whole.values[from];
      front.push_back(to);
    };
    visit(column > 0, from - 1);
    visit(column + 1 < columns, from + 1);
    visit(from >= columns, from - columns);
    visit(from + columns < count, from + columns);
  }
}

double expected_at(const Whole& whole, const Between& place) {
  const std::int64_t column = std::min(place.column + 1, whole.cells.column_end() - 1),
                     row = std::min(place.row + 1, whole.cells.row_end() - 1);
  return std::lerp(
      std::lerp(whole.at(place.column, place.row), whole.at(column, place.row), place.right),
      std::lerp(whole.at(place.column, row), whole.at(column, row), place.right), place.down);
}

bool any_data_around(const Whole& whole, const CellBox& window, const Between& place) {
  const std::int64_t column = std::min(place.column + 1, window.column_end() - 1),
                     row = std::min(place.row + 1, window.row_end() - 1);
  for (const std::int64_t i : {place.column, column})
    for (const std::int64_t j : {place.row, row})
      if (!std::isnan(whole.at(i, j))) return true;
  return false;
}

struct Case {
  CellBox window;
  std::int64_t columns, rows;  // size of blocks
  RasterValues::Memory memory;
};

// A raster in which the number -1 means no data.
struct Raster {
  Whole whole;
  std::map<std::int64_t, int> reads;  // number of reads by the first cell of a block

  RasterBlock read(const CellBox& cells) {
    ++reads[cells.row * 100000 + cells.column];
    std::vector<float> numbers;
    for (std::int64_t row = cells.row; row < cells.row_end(); ++row)
      for (std::int64_t column = cells.column; column < cells.column_end(); ++column) {
        const double value = whole.at(column, row);
        numbers.push_back(std::isnan(value) ? -1 : static_cast<float>(value));
      }
    NumberConversion meaning;
    meaning.has_no_data = true, meaning.no_data = -1, meaning.scale = 0.5, meaning.offset = 3;
    return {cells, std::move(numbers), meaning};
  }
};

Raster some_raster(std::int64_t columns, std::int64_t rows, double part_with_data) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(0, 1);
  Raster raster;
  raster.whole.cells = {0, 0, columns, rows};
  for (std::int64_t i = 0; i < columns * rows; ++i)
    raster.whole.values.push_back(part(random) < part_with_data ? static_cast<float>(i % 9973)
                                                                : nothing);
  return raster;
}

std::vector<Between> some_places(const CellBox& window, int count) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> part(0, 1);
  std::vector<Between> places;
  for (int i = 0; i < count; ++i) {
    Between place{};
    place.column = window.column +
                   static_cast<std::int64_t>(part(random) * static_cast<double>(window.columns));
    place.row =
        window.row + static_cast<std::int64_t>(part(random) * static_cast<double>(window.rows));
    place.right = i % 5 == 0 ? 0 : part(random), place.down = i % 7 == 0 ? 0 : part(random);
    places.push_back(place);
  }
  return places;
}

void expect_the_same(Raster& raster, const Case& it, int count = 3000) {
  Whole window{it.window, {}};
  for (std::int64_t row = it.window.row; row < it.window.row_end(); ++row)
    for (std::int64_t column = it.window.column; column < it.window.column_end(); ++column)
      window.values.push_back(0.5 * raster.whole.at(column, row) + 3);
  fill_all(window);
  RasterValues values([&](const CellBox& cells) { return raster.read(cells); }, it.window,
                      it.columns, it.rows, it.memory);
  ck_assert(values.has_data());
  const std::vector<Between> places = some_places(it.window, count);
  std::vector<double> found(places.size());
  std::vector<std::int32_t> has_data(places.size());
  values.interpolate(places, found.data(), has_data.data());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double expected = expected_at(window, places[i]);
    ck_assert_int_eq(has_data[i], any_data_around(raster.whole, it.window, places[i]) ? 1 : 0);
    ck_assert_msg(std::memcmp(&found[i], &expected, sizeof expected) == 0,
                  "%.17g is not %.17g, between columns from %lld and rows from %lld", found[i],
                  expected, static_cast<long long>(places[i].column),
                  static_cast<long long>(places[i].row));
  }
}

constexpr RasterValues::Memory plenty{1 << 28, 1 << 28}, hardly_any{1, 1};

}  // namespace

START_TEST(with_data_everywhere) {
  Raster raster = some_raster(200, 150, 2);
  for (const RasterValues::Memory& memory : {plenty, hardly_any})
    for (const CellBox& window : {CellBox{0, 0, 200, 150}, CellBox{13, 17, 120, 99},
                                  CellBox{50, 60, 1, 70}, CellBox{199, 149, 1, 1}})
      for (const auto& [columns, rows] :
           {std::array<std::int64_t, 2>{16, 16}, {200, 3}, {7, 150}, {512, 512}})
        expect_the_same(raster, {window, columns, rows, memory});
}
END_TEST

START_TEST(with_gaps) {
  for (const double part : {0.9, 0.3, 0.01}) {
    Raster raster = some_raster(300, 280, part);
    for (const RasterValues::Memory& memory : {plenty, hardly_any})
      for (const CellBox& window : {CellBox{0, 0, 300, 280}, CellBox{33, 17, 250, 240}})
        expect_the_same(raster, {window, 64, 32, memory}, memory.blocks > 1 ? 3000 : 50);
  }
}
END_TEST

// The nearest data are several tiles away, also at the same distance in several directions.
START_TEST(far_from_data) {
  Raster raster = some_raster(1100, 900, 0);
  const auto put = [&](std::int64_t column, std::int64_t row, double value) {
    raster.whole.values[raster.whole.cells.place_of(column, row)] = value;
  };
  put(1090, 880, 1);
  expect_the_same(raster, {{0, 0, 1100, 900}, 256, 256, plenty});
  put(10, 880, 2), put(10, 20, 5), put(1090, 20, 7), put(511, 512, 9), put(512, 511, 11);
  expect_the_same(raster, {{0, 0, 1100, 900}, 256, 256, plenty});
  expect_the_same(raster, {{0, 0, 1100, 900}, 1100, 20, plenty});
}
END_TEST

START_TEST(without_data) {
  Raster raster = some_raster(90, 80, 0);
  RasterValues values([&](const CellBox& cells) { return raster.read(cells); }, {0, 0, 90, 80}, 32,
                      32, plenty);
  ck_assert(!values.has_data());
}
END_TEST

// A batch reads each block once, for any order of the points and for any size of the memory.
START_TEST(a_block_is_read_once) {
  Raster raster = some_raster(400, 300, 2);
  RasterValues values([&](const CellBox& cells) { return raster.read(cells); }, {0, 0, 400, 300},
                      32, 32, hardly_any);
  const std::vector<Between> places = some_places({0, 0, 400, 300}, 20000);
  std::vector<double> found(places.size());
  values.interpolate(places, found.data());
  ck_assert_int_eq(raster.reads.size(), 13 * 10);
  for (const auto& [block, times] : raster.reads) ck_assert_int_eq(times, 1);
}
END_TEST

TEST_SUITE(test_raster_values) {
  Suite* suite = suite_create("values between the cells of a raster");
  TCase* cases = tcase_create("all");
  tcase_add_test(cases, with_data_everywhere);
  tcase_add_test(cases, with_gaps);
  tcase_add_test(cases, far_from_data);
  tcase_add_test(cases, without_data);
  tcase_add_test(cases, a_block_is_read_once);
  suite_add_tcase(suite, cases);
  return run_suite(suite);
}
