// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/sphere_grid_spacing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/point_text.hpp"
#include "base/started_execution.hpp"
#include "sphere/degrees.hpp"
#include "sphere/great_circle.hpp"

namespace pnpbs {

namespace {

constexpr double kTurn = 360;

// Returns the angle from the last column to the first after a full turn.
double open_degrees(const DegreeGrid& grid, std::int64_t columns) {
  return kTurn - static_cast<double>(columns - 1) * grid.step[0];
}

// Returns the angle eastwards from one longitude to another, in [0, 360).
double degrees_east(double from, double to) {
  const double way = to - from;
  return std::clamp(way - kTurn * std::floor(way / kTurn), 0.0, std::nextafter(kTurn, 0.0));
}

// Returns the angle to the nearest point of a meridian between two latitudes. [radians] The cosine
// of the angle to a point of the meridian is a multiple of cos(latitude - nearest), so it decreases
// on both sides of the nearest point.
double angle_to_meridian(const Point<3>& direction, double longitude, double low, double high) {
  const Point<3> meridian = direction_at({longitude, 0});
  const double nearest =
      std::atan2(direction[2], direction[0] * meridian[0] + direction[1] * meridian[1]) / kDegree;
  double least = std::numbers::pi;
  for (const double latitude : {low, std::clamp(nearest, low, high), high})
    least = std::min(least, angle_between(direction, direction_at({longitude, latitude})));
  return least;
}

}  // namespace

bool SphereGridSpacing::repeats_first_column(const DegreeGrid& grid) {
  return grid.columns > 1 && open_degrees(grid, grid.columns) <= kRounding * grid.step[0];
}

SphereGridSpacing::SphereGridSpacing(DegreeGrid grid, double radius)
    : grid_(std::move(grid)),
      radius_(radius),
      columns_(grid_.columns - (repeats_first_column(grid_) ? 1 : 0)),
      closed_(columns_ == 1 || open_degrees(grid_, columns_) <= (1 + kRounding) * grid_.step[0]),
      low_{grid_.origin[0] - 0.5 * grid_.step[0], -90},
      high_{grid_.longitude(columns_ - 1) + 0.5 * grid_.step[0], 90} {
  if (grid_.rows == 1) return;
  join_at_pole(-90, 0, south_);
  join_at_pole(90, grid_.rows - 1, north_);
  if (!south_) low_[1] = grid_.latitude(0) - 0.5 * grid_.step[1];
  if (!north_) high_[1] = grid_.latitude(grid_.rows - 1) + 0.5 * grid_.step[1];
}

// Sets the value at a pole if the row comes close to it. The values of a row on the pole itself all
// become this value.
void SphereGridSpacing::join_at_pole(double pole, std::int64_t row, std::optional<double>& value) {
  const double away = std::fabs(grid_.latitude(row) - pole) / grid_.step[1];
  if (away > 1 + kRounding) return;
  const auto begin = grid_.values.begin() + static_cast<std::ptrdiff_t>(row * grid_.columns);
  double sum = 0;
  for (auto v = begin; v != begin + static_cast<std::ptrdiff_t>(columns_); ++v) sum += *v;
  value = sum / static_cast<double>(columns_);
  if (away <= kRounding) std::fill_n(begin, grid_.columns, *value);
}

SpacingHints<3> SphereGridSpacing::spacing_hints() const {
  constexpr double kMatters = 0.1;
  SpacingHints<3> known;
  std::vector<char> is_low(grid_.values.size(), 0);
  const auto point = [&](std::int64_t row, std::int64_t column) {
    return shifted({}, radius_, direction_at({grid_.longitude(column), grid_.latitude(row)}));
  };
  const auto index = [&](std::int64_t row, std::int64_t column) {
    return static_cast<std::size_t>(row * grid_.columns + column);
  };
  const auto compare = [&](std::int64_t row, std::int64_t column, std::int64_t to_row,
                           std::int64_t to_column) {
    const double a = grid_.values[index(row, column)], b = grid_.values[index(to_row, to_column)];
    if (!(std::fabs(a - b) > kMatters * std::min(a, b))) return;
    const Point<3> x = point(row, column), y = point(to_row, to_column);
    const double along = radius_ * angle_between(x, y);
    if (!(along > 0)) return;
    is_low[a < b ? index(row, column) : index(to_row, to_column)] = 1;
    known.slopes.push_back({std::fabs(a - b) / along, std::min(a, b),
                            shifted({}, radius_, unit_vector(halfway(x, y)))});
  };
  for (std::int64_t row = 0; row < grid_.rows; ++row)
    for (std::int64_t column = 0; column < columns_; ++column) {
      if (row + 1 < grid_.rows) compare(row, column, row + 1, column);
      if (column + 1 < columns_) compare(row, column, row, column + 1);
      if (column + 1 == columns_ && closed_) compare(row, column, row, 0);
    }
  for (std::int64_t row = 0; row < grid_.rows; ++row)
    for (std::int64_t column = 0; column < columns_; ++column)
      if (is_low[index(row, column)])
        known.values.push_back({point(row, column), grid_.values[index(row, column)]});
  return known;
}

SphereGridSpacing::Between SphereGridSpacing::columns_at(double longitude) const {
  if (columns_ == 1) return {0, 0, 0};
  const std::int64_t last = columns_ - 1;
  const double along = degrees_east(grid_.origin[0], longitude), step = grid_.step[0],
               whole = static_cast<double>(last) * step;
  if (along < whole) {
    const std::int64_t first = std::min(static_cast<std::int64_t>(along / step), last - 1);
    return {first, first + 1, std::min(along / step - static_cast<double>(first), 1.0)};
  }
  const double part = (along - whole) / (kTurn - whole);
  if (closed_) return {last, 0, part};
  const std::int64_t nearest = part < 0.5 ? last : 0;
  return {nearest, nearest, 0};
}

double SphereGridSpacing::in_row(std::int64_t row, const Between& columns) const {
  const auto value = [&](std::int64_t column) {
    return grid_.values[static_cast<std::size_t>(row * grid_.columns + column)];
  };
  return std::lerp(value(columns.first), value(columns.second), columns.part);
}

double SphereGridSpacing::at(const Point<2>& degrees) const {
  const Between columns = columns_at(degrees[0]);
  const std::int64_t last = grid_.rows - 1;
  if (last == 0) return in_row(0, columns);
  const double south = grid_.latitude(0), north = grid_.latitude(last);
  const auto beyond = [&](std::int64_t row, const std::optional<double>& pole, double way,
                          double whole) {
    const double here = in_row(row, columns);
    return pole && whole > 0 ? std::lerp(here, *pole, std::min(way / whole, 1.0)) : here;
  };
  if (degrees[1] <= south) return beyond(0, south_, south - degrees[1], south + 90);
  if (degrees[1] >= north) return beyond(last, north_, degrees[1] - north, 90 - north);
  const double t = (degrees[1] - south) / grid_.step[1];
  const std::int64_t row = std::min(static_cast<std::int64_t>(t), last - 1);
  return std::lerp(in_row(row, columns), in_row(row + 1, columns),
                   std::min(t - static_cast<double>(row), 1.0));
}

void SphereGridSpacing::evaluate(std::int64_t n, const Point<3>* x, double* d) const {
  for_each_if_started("pnpbs::SphereGridSpacing::evaluate", n,
                      [=, this](std::int64_t i) { d[i] = at(degrees_of(x[i])); });
}

std::optional<GivenExtent<3>> SphereGridSpacing::extent() const {
  const auto place = [&](const Point<2>& degrees) {
    return (closed_ ? "" : "longitude " + rounded_text(degrees[0]) + ", ") + "latitude " +
           rounded_text(degrees[1]);
  };
  return GivenExtent<3>{"grid",
                        "d is that of the grid's nearest point",
                        {},
                        "from " + place(low_) + " to " + place(high_)};
}

double SphereGridSpacing::angle_beyond(const Point<3>& x) const {
  const Point<2> degrees = degrees_of(x);
  if (closed_ || degrees_east(low_[0], degrees[0]) <= high_[0] - low_[0])
    return std::max({0.0, low_[1] - degrees[1], degrees[1] - high_[1]}) * kDegree;
  const Point<3> direction = unit_vector(x);
  return std::min(angle_to_meridian(direction, low_[0], low_[1], high_[1]),
                  angle_to_meridian(direction, high_[0], low_[1], high_[1]));
}

void SphereGridSpacing::distance_to_extent(std::int64_t n, const Point<3>* x,
                                           double* distances) const {
  for_each_if_started("pnpbs::SphereGridSpacing::distance_to_extent", n,
                      [=, this](std::int64_t i) { distances[i] = radius_ * angle_beyond(x[i]); });
}

}  // namespace pnpbs
