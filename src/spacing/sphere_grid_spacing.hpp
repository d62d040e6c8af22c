// SPDX-License-Identifier: BSD-3-Clause
// The spacing from values on a grid of longitudes and latitudes. It is bilinear between grid
// points, and outside of the grid it is that of the nearer edge. Columns that go all around are
// joined. If the grid comes within one step of a pole, the pole has the mean of the adjacent row.
// Hence d jumps neither at the meridian where such a grid begins nor at the poles.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "spacing/spacing.hpp"
#include "sphere/stereographic_chart.hpp"

namespace pnpbs {

// A grid of longitudes and latitudes. Rows are parallels, along which longitudes increase.
// [degrees]
struct DegreeGrid {
  std::int64_t columns, rows;
  Point<2> origin, step;       // longitude, latitude
  std::vector<double> values;  // [rows][columns]

  double longitude(std::int64_t column) const { return at(0, column); }
  double latitude(std::int64_t row) const { return at(1, row); }

 private:
  double at(std::size_t axis, std::int64_t i) const {
    return origin[axis] + static_cast<double>(i) * step[axis];
  }
};

// A spacing on a sphere, interpolated in a DegreeGrid.
class SphereGridSpacing : public LocalSpacing<3> {
 public:
  // Tolerance by which columns may miss a full turn, and rows a pole, and still count as meeting
  // them. [steps] Derived: a step of six digits accumulates this error after 100 000 columns.
  static constexpr double kRounding = 0.1;

  // `grid` must go around once at most and have valid latitudes.
  SphereGridSpacing(DegreeGrid grid, double radius);

  void evaluate(std::int64_t n, const Point<3>* x, double* d) const override;
  // Returns the hints as for a grid in the plane, with lengths along the sphere.
  SpacingHints<3> spacing_hints() const override;
  std::optional<GivenExtent<3>> extent() const override;
  void distance_to_extent(std::int64_t n, const Point<3>* x, double* distances) const override;

  // Returns whether the last column is the first one again after a full turn.
  static bool repeats_first_column(const DegreeGrid& grid);

 private:
  // A position between two adjacent columns, as a share of the step from the first to the second.
  struct Between {
    std::int64_t first, second;
    double part;
  };

  Between columns_at(double longitude) const;
  double in_row(std::int64_t row, const Between& columns) const;
  void join_at_pole(double pole, std::int64_t row, std::optional<double>& value);
  double at(const Point<2>& degrees) const;
  double angle_beyond(const Point<3>& x) const;

  DegreeGrid grid_;
  double radius_;
  std::int64_t columns_;  // number of distinct columns
  bool closed_;           // the last column is adjacent to the first
  // Values at the poles, if the grid comes close to them.
  std::optional<double> south_, north_;
  Point<2> low_, high_;  // covered longitudes and latitudes
};

}  // namespace pnpbs
