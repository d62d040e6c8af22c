// SPDX-License-Identifier: BSD-3-Clause
// The spacing from values on a grid of longitudes and latitudes: linear in both between grid
// points, and beyond the grid that of its nearer edge. Columns that go all around are joined, and
// where the grid comes within a step of a pole, the pole has the mean of the row next to it: so d
// has no jump at the meridian where such a grid begins, nor at poles.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "spacing/spacing.hpp"
#include "sphere/stereographic_chart.hpp"

namespace pnpbs {

// Rows are parallels; longitudes run along them. In degrees.
struct DegreeGrid {
  std::int64_t columns, rows;
  Point<2> origin, step;       // longitude and latitude
  std::vector<double> values;  // [rows][columns]

  double longitude(std::int64_t column) const { return at(0, column); }
  double latitude(std::int64_t row) const { return at(1, row); }

 private:
  double at(std::size_t axis, std::int64_t i) const {
    return origin[axis] + static_cast<double>(i) * step[axis];
  }
};

class SphereGridSpacing : public LocalSpacing<3> {
 public:
  // By how much columns may miss a full turn, and rows a pole, and still be meant to meet them.
  // [steps] A step with six digits does so after 100 000 columns.
  static constexpr double kRounding = 0.1;

  // Of a grid that goes around once at most, with latitudes of the sphere.
  SphereGridSpacing(DegreeGrid grid, double radius);

  void evaluate(std::int64_t n, const Point<3>* x, double* d) const override;
  // As of a grid in the plane, with lengths along the sphere.
  SpacingHints<3> spacing_hints() const override;
  std::optional<GivenExtent<3>> extent() const override;
  void distance_to_extent(std::int64_t n, const Point<3>* x, double* distances) const override;

  // Of a column that comes again at the end of a full turn, as at its beginning.
  static bool repeats_first_column(const DegreeGrid& grid);

 private:
  // A place between two neighbours, as a part of the way from one to the other.
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
  std::int64_t columns_;  // that are different
  bool closed_;           // the last one is beside the first
  std::optional<double> south_, north_;
  Point<2> low_, high_;  // what it covers
};

}  // namespace pnpbs
