// SPDX-License-Identifier: BSD-3-Clause
#include "geo/grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/point_text.hpp"
#include "sphere/slopes.hpp"

namespace pnpbs::geo {
namespace {

constexpr double no_end = std::numeric_limits<double>::infinity();

// Applies an affine transformation in GDAL's form.
Point<2> applied(const std::array<double, 6>& affine, const Point<2>& p) {
  return {affine[0] + affine[1] * p[0] + affine[2] * p[1],
          affine[3] + affine[4] * p[0] + affine[5] * p[1]};
}

// Tolerance for a grid that goes around the Earth. [degrees]
constexpr double kSameLongitude = 1e-6;

bool is_somewhere(const Point<2>& p) { return std::isfinite(p[0]) && std::isfinite(p[1]); }

Box<2> box_around_finite(const std::vector<Point<2>>& points) {
  Box<2> box{{no_end, no_end}, {-no_end, -no_end}};
  for (const Point<2>& p : points) {
    if (!is_somewhere(p)) continue;
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
      box.low[k] = std::min(box.low[k], p[k]);
      box.high[k] = std::max(box.high[k], p[k]);
    }
  }
  return box;
}

// Returns points of a regular lattice over the box, including its sides.
std::vector<Point<2>> lattice_over(const Box<2>& box) {
  constexpr int pieces = 32;
  std::vector<Point<2>> points;
  for (int i = 0; i <= pieces; ++i)
    for (int j = 0; j <= pieces; ++j)
      points.push_back({std::lerp(box.low[0], box.high[0], i / double{pieces}),
                        std::lerp(box.low[1], box.high[1], j / double{pieces})});
  return points;
}

MessageText extents_text(const Box<2>& box) {
  return "from " + rounded_point_text<2>(box.low) + " to " + rounded_point_text<2>(box.high);
}

}  // namespace

Grid::Grid(const GridRequest& request) : file_(request.path, request.variable) {
  name_ = file_.name();
  columns_ = file_.columns(), rows_ = file_.rows();
  to_plane_ = file_.to_plane();
  if (!GDALInvGeoTransform(to_plane_.data(), to_cells_.data()))
    throw Error(ErrorKind::file, name_ + ": its cells have no area");
  choose_system(request, file_.system());
  measure_extent();
  window_ = window_for(request);
  const double around = static_cast<double>(columns_) * std::fabs(to_plane_[1]);
  goes_around_ = wraps_ && to_plane_[2] == 0 && window_.columns == columns_ &&
                 std::fabs(around - 360) < kSameLongitude;
  const auto [columns, rows] = file_.shape_of_blocks();
  values_ =
      std::make_unique<RasterValues>([this](const CellBox& cells) { return file_.read(cells); },
                                     window_, columns, rows, RasterValues::Memory{});
  if (!values_->has_data())
    throw Error(ErrorKind::spacing, name_ + ": it has no data in the domain");
}

void Grid::choose_system(const GridRequest& request, const ReferenceSystem& system) {
  wraps_ = system.is_geographic() && system.has_degrees();
  if (request.projection.empty() || !system) return;
  const ReferenceSystem plane = ReferenceSystem::called(request.projection);
  if (OSRIsSame(plane.get(), system.get())) return;
  forward_.emplace(plane, system);
  backward_.emplace(system, plane);
}

void Grid::measure_extent() {
  std::vector<Point<2>> points =
      lattice_over({{0, 0}, {static_cast<double>(columns_), static_cast<double>(rows_)}});
  for (Point<2>& p : points) p = applied(to_plane_, p);
  if (backward_) backward_->apply(points);
  extent_ = box_around_finite(points);
}

std::vector<Point<2>> Grid::cells_of(std::vector<Point<2>> points) const {
  if (forward_) forward_->apply(points);
  const double middle = applied(
      to_plane_, {0.5 * static_cast<double>(columns_), 0.5 * static_cast<double>(rows_)})[0];
  for (Point<2>& p : points) {
    if (wraps_ && is_somewhere(p)) p[0] = middle + std::remainder(p[0] - middle, 360);
    p = applied(to_cells_, p);
    p[0] -= 0.5, p[1] -= 0.5;
  }
  return points;
}

CellBox Grid::window_for(const GridRequest& request) const {
  // Margin around the cells of the requested part, whose sides are curved between the points of the
  // lattice. [share of its width]
  constexpr double more = 0.05;
  const Box<2> box = box_around_finite(cells_of(lattice_over(request.part)));
  const std::int64_t counts[2] = {columns_, rows_};
  std::int64_t first[2], last[2];
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    const double end = static_cast<double>(counts[k] - 1);
    if (!(box.low[k] <= end + 0.5 && box.high[k] >= -0.5))
      throw Error(ErrorKind::spacing,
                  name_ + ": the grid lies outside of the domain, " + extents_text(extent_) +
                      ", and the domain reaches " + extents_text(request.part) +
                      (forward_ ? "" : ": are they in the same coordinate reference system?"));
    const double pad = 2 + more * (box.high[k] - box.low[k]);
    first[k] = static_cast<std::int64_t>(std::clamp(std::floor(box.low[k] - pad), 0.0, end));
    last[k] = static_cast<std::int64_t>(std::clamp(std::ceil(box.high[k] + pad), 0.0, end));
  }
  return {first[0], first[1], last[0] - first[0] + 1, last[1] - first[1] + 1};
}

void Grid::evaluate(const std::vector<Point<2>>& points, double* values,
                    std::int32_t* inside) const {
  const std::lock_guard<std::mutex> lock(one_at_a_time_);
  const std::vector<Point<2>> cells = cells_of(points);
  const double counts[2] = {static_cast<double>(columns_), static_cast<double>(rows_)};
  const std::int64_t first[2] = {window_.column, window_.row};
  const std::int64_t size[2] = {window_.columns, window_.rows};
  // A point between the last and the first column of a grid that goes around the Earth.
  struct OverSeam {
    std::size_t point;
    double part;  // position between the last column (0) and the first one (1)
  };
  std::vector<OverSeam> over_seam;
  std::vector<Between> places;
  places.reserve(points.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!is_somewhere(cells[i]))
      throw Error(ErrorKind::spacing,
                  point_text(points[i]) + " cannot be transformed to the coordinates of " + name_);
    std::int64_t cell[2];
    double fraction[2];
    bool within = true;
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
      within = within && cells[i][k] >= -1 && cells[i][k] <= counts[k];
      const double at = std::clamp(cells[i][k] - static_cast<double>(first[k]), 0.0,
                                   static_cast<double>(size[k] - 1));
      cell[k] = static_cast<std::int64_t>(at);
      fraction[k] = at - static_cast<double>(cell[k]);
    }
    const double last = counts[0] - 1;
    if (goes_around_ && (cells[i][0] < 0 || cells[i][0] > last)) {
      over_seam.push_back({i, cells[i][0] < 0 ? 1 + cells[i][0] : cells[i][0] - last});
      cell[0] = columns_ - 1, fraction[0] = 0;
    }
    places.push_back({first[0] + cell[0], first[1] + cell[1], fraction[0], fraction[1]});
    if (inside) inside[i] = within ? 1 : 0;
  }
  for (const OverSeam& at : over_seam)
    places.push_back({0, places[at.point].row, 0, places[at.point].down});
  std::vector<double> found(places.size());
  std::vector<std::int32_t> has_data(inside ? places.size() : 0);
  values_->interpolate(places, found.data(), inside ? has_data.data() : nullptr);
  std::copy_n(found.begin(), points.size(), values);
  for (std::size_t k = 0; k < over_seam.size(); ++k) {
    const auto& [point, part] = over_seam[k];
    values[point] = std::lerp(values[point], found[points.size() + k], part);
    if (inside && has_data[points.size() + k] != 0) has_data[point] = 1;
  }
  for (std::size_t i = 0; inside && i < points.size(); ++i)
    if (inside[i] != 0 && has_data[i] == 0) inside[i] = 2;
}

void evaluate_slopes(const Grid& grid, double radius, const std::vector<Point<2>>& points,
                     double* slopes) {
  const auto count = static_cast<std::int64_t>(points.size());
  if (count == 0) return;
  const auto of_plane = [&](std::int64_t n, const double* coordinates, double* values) {
    std::vector<Point<2>> places(static_cast<std::size_t>(n));
    for (std::size_t i = 0; i < places.size(); ++i)
      places[i] = {coordinates[2 * i], coordinates[2 * i + 1]};
    grid.evaluate(places, values, nullptr);
  };
  if (radius == 0) {
    const Box<2>& box = grid.extent();
    const double side =
        longest_finite_side({{box.low[0], box.low[1], 0}, {box.high[0], box.high[1], 0}});
    slopes_of(of_plane, 2, false, side, count, points[0].data(), slopes);
    return;
  }
  const auto of_sphere = [&](std::int64_t n, const double* coordinates, double* values) {
    std::vector<Point<2>> places(static_cast<std::size_t>(n));
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double* x = coordinates + 3 * i;
      places[i] = degrees_of({x[0], x[1], x[2]});
    }
    grid.evaluate(places, values, nullptr);
  };
  std::vector<double> on_sphere;
  for (const Point<2>& degrees : points)
    for (const double coordinate : direction_at(degrees)) on_sphere.push_back(radius * coordinate);
  slopes_of(of_sphere, 3, true, 0, count, on_sphere.data(), slopes);
}

}  // namespace pnpbs::geo
