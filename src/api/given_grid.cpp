// SPDX-License-Identifier: BSD-3-Clause
#include "api/given_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "api/guard.hpp"
#include "base/point_text.hpp"
#include "domain/given_values.hpp"
#include "spacing/given_field.hpp"
#include "spacing/sphere_grid_spacing.hpp"

namespace pnpbs::api {

namespace {

// Returns the text "[y][x]" of the i-th value on a grid. The index that varies fastest is last.
template <int Dim>
std::string grid_index(std::int64_t i, const std::int64_t* size) {
  std::string text;
  for (int k = 0; k < Dim; ++k) {
    text.insert(0, "[" + std::to_string(i % size[k]) + "]");
    i /= size[k];
  }
  return text;
}

// Returns the point of the i-th value on a grid.
template <int Dim>
Point<Dim> grid_point(std::int64_t i, const GridArguments& grid) {
  Point<Dim> x;
  for (std::size_t k = 0; k < Dim; ++k) {
    x[k] = grid.origin[k] + static_cast<double>(i % grid.size[k]) * grid.step[k];
    i /= grid.size[k];
  }
  return x;
}

// Checks a grid except for its values. Returns the number of values.
template <int Dim>
std::int64_t check_grid(const GridArguments& grid) {
  require_pointer(grid.size, "size");
  require_pointer(grid.origin, "origin");
  require_pointer(grid.step, "step");
  require_pointer(grid.values, "values");
  constexpr std::int64_t kMax = std::int64_t{1} << 31;
  std::int64_t n = 1;
  for (int k = 0; k < Dim; ++k) {
    const std::string at = "[" + std::to_string(k) + "] = ";
    const std::int64_t size = grid.size[k];
    if (size < 1 || size > kMax)
      throw Error(ErrorKind::argument,
                  "argument size" + at + std::to_string(size) + " must be in 1 .. 2^31");
    if (!std::isfinite(grid.origin[k]))
      throw Error(ErrorKind::argument,
                  "argument origin" + at + number_text(grid.origin[k]) + " must be finite");
    if (!std::isfinite(grid.step[k]) || grid.step[k] <= 0)
      throw Error(ErrorKind::argument,
                  "argument step" + at + number_text(grid.step[k]) + " must be greater than 0");
    if (n > std::numeric_limits<std::int64_t>::max() / size)
      throw Error(ErrorKind::argument, "argument size: the number of values exceeds 2^63 - 1");
    n *= size;
  }
  return n;
}

bool is_spacing(double value) { return std::isfinite(value) && value > 0; }

// Throws if the grid covers more than one turn or reaches beyond the poles.
void require_degrees_of_sphere(const DegreeGrid& grid) {
  constexpr double kMostTurns = 3600, kRounding = SphereGridSpacing::kRounding;
  if (std::fabs(grid.origin[0]) > kMostTurns)
    given_values::reject("argument origin[0] = " + number_text(grid.origin[0]) +
                         ": expected a longitude in degrees");
  const double around = static_cast<double>(grid.columns - 1) * grid.step[0];
  if (around > 360 + kRounding * grid.step[0])
    given_values::reject("argument size[0] = " + std::to_string(grid.columns) +
                         ": that many longitudes " + number_text(grid.step[0]) +
                         " degrees apart are " + number_text(around) +
                         " degrees, expected 360 at most, from the first to the last");
  const double beyond = kRounding * grid.step[1];
  if (grid.latitude(0) < -90 - beyond || grid.latitude(0) > 90 + beyond)
    given_values::reject("argument origin[1] = " + number_text(grid.origin[1]) +
                         ": expected a latitude from -90 to 90 degrees");
  if (grid.latitude(grid.rows - 1) > 90 + beyond)
    given_values::reject("argument size[1] = " + std::to_string(grid.rows) +
                         ": the last latitude is " + number_text(grid.latitude(grid.rows - 1)) +
                         ", expected 90 degrees at most");
}

std::string value_text(const DegreeGrid& grid, std::int64_t row, std::int64_t column) {
  const std::int64_t size[2] = {grid.columns, grid.rows}, i = row * grid.columns + column;
  return "argument values" + grid_index<2>(i, size) + " = " +
         number_text(grid.values[static_cast<std::size_t>(i)]);
}

std::string place_text(const DegreeGrid& grid, std::int64_t row, std::int64_t column) {
  return " at " + degrees_text({grid.longitude(column), grid.latitude(row)});
}

void require_spacings(const DegreeGrid& grid) {
  const auto value = [&](std::int64_t row, std::int64_t column) {
    return grid.values[static_cast<std::size_t>(row * grid.columns + column)];
  };
  for (std::int64_t row = 0; row < grid.rows; ++row)
    for (std::int64_t column = 0; column < grid.columns; ++column)
      if (!is_spacing(value(row, column)))
        throw Error(ErrorKind::spacing, value_text(grid, row, column) +
                                            place_text(grid, row, column) +
                                            ": the spacing must be finite and greater than 0");
  if (!SphereGridSpacing::repeats_first_column(grid)) return;
  constexpr double kSinglePrecision = 1e-6;  // allows for some rounding errors
  const std::int64_t last = grid.columns - 1;
  for (std::int64_t row = 0; row < grid.rows; ++row)
    if (std::fabs(value(row, last) - value(row, 0)) > kSinglePrecision * value(row, 0))
      throw Error(ErrorKind::spacing,
                  value_text(grid, row, 0) + " and " + value_text(grid, row, last) + " are both" +
                      place_text(grid, row, 0) + ", a full turn apart: a point has one spacing");
}

}  // namespace

template <int Dim>
std::shared_ptr<const GridSpacing<Dim>> spacing_on_grid(const GridArguments& grid) {
  const std::int64_t n = check_grid<Dim>(grid);
  for (std::int64_t i = 0; i < n; ++i)
    if (!is_spacing(grid.values[i]))
      throw Error(ErrorKind::spacing, "argument values" + grid_index<Dim>(i, grid.size) + " = " +
                                          number_text(grid.values[i]) + " at " +
                                          point_text(grid_point<Dim>(i, grid)) +
                                          ": the spacing must be finite and greater than 0");
  std::array<std::int64_t, Dim> counts;
  Point<Dim> from, by;
  std::copy_n(grid.size, Dim, counts.begin());
  std::copy_n(grid.origin, Dim, from.begin());
  std::copy_n(grid.step, Dim, by.begin());
  return std::make_shared<GridSpacing<Dim>>(counts, from, by,
                                            std::vector<double>(grid.values, grid.values + n));
}

std::shared_ptr<const LocalSpacing<3>> spacing_on_sphere_grid(const GridArguments& grid,
                                                              double radius) {
  const std::int64_t n = check_grid<2>(grid);
  DegreeGrid on_sphere{grid.size[0],
                       grid.size[1],
                       {grid.origin[0], grid.origin[1]},
                       {grid.step[0], grid.step[1]},
                       {}};
  require_degrees_of_sphere(on_sphere);
  on_sphere.values.assign(grid.values, grid.values + n);
  require_spacings(on_sphere);
  return std::make_shared<SphereGridSpacing>(std::move(on_sphere), radius);
}

template std::shared_ptr<const GridSpacing<2>> spacing_on_grid(const GridArguments&);
template std::shared_ptr<const GridSpacing<3>> spacing_on_grid(const GridArguments&);

}  // namespace pnpbs::api
