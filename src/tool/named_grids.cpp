// SPDX-License-Identifier: BSD-3-Clause
#include "tool/named_grids.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "spacing/outside_domain.hpp"
#include "sphere/slopes.hpp"
#include "tool/density.hpp"
#include "tool/formula_text.hpp"
#include "tool/library.hpp"
#include "tool/named_grid.hpp"
#include "tool/numbers.hpp"
#include "tool/ranks.hpp"

namespace pnpbs::tool {
namespace {

// Returns the name of the slope of a grid in formulas: NAME_slope.
std::string slope_name(const std::string& grid) { return grid + "_slope"; }

// Computes the magnitude of the gradient of the values, along x and y (and z in space) or along a
// sphere. Between the centres of cells it is the gradient of the multilinear interpolation.
void evaluate_slope(const NamedGrid& grid, int dimension, bool on_sphere, std::int64_t n,
                    const double* coordinates, double* slopes) {
  const auto values = [&](std::int64_t count, const double* places, double* there) {
    grid.evaluate(count, places, there, nullptr);
  };
  slopes_of(values, dimension, on_sphere, longest_finite_side(grid.extent()), n, coordinates,
            slopes);
}

// Counts at how many nodes a grid in a formula, or a grid that is d, has values of its own.
class GridCoverage {
 public:
  // Counts over the current nodes; the results are on the first rank only. Messages give points on
  // a sphere in degrees. Collective. Throws Failure.
  GridCoverage(const NamedGrid& grid, pnpbs_placement placement, int dimension, bool on_sphere,
               pnpbs_context context, const Ranks& ranks);

  bool is_nowhere() const { return nodes_ > 0 && beyond_.count + without_data_.count == nodes_; }
  std::string nowhere_message() const;
  // Returns how many nodes lie beyond the edge of the grid, or where it has no data; "" if none do.
  std::string beyond_message() const;
  std::string without_data_message() const;
  // Returns "" unless the depth is nowhere positive. The values are depths, or elevations.
  std::string dry_message(const DepthRequest& request) const;

 private:
  struct Nodes {
    std::int64_t count;
    Point<3> first;  // the lexicographically smallest of their positions
  };
  void count(Nodes& nodes, const Point<3>& place) const;
  void add_up(const Ranks& ranks);
  std::string grid_in_words() const;
  std::string text_of(const Nodes& nodes, const std::string& what) const;

  std::string name_, path_;
  int dimension_;
  bool on_sphere_;
  std::int64_t nodes_ = 0, positive_ = 0, negative_ = 0;  // nodes, by the sign of the value there
  Nodes beyond_, without_data_;
};

constexpr double none_yet = std::numeric_limits<double>::infinity();

GridCoverage::GridCoverage(const NamedGrid& grid, pnpbs_placement placement, int dimension,
                           bool on_sphere, pnpbs_context context, const Ranks& ranks)
    : name_(grid.name()),
      path_(grid.path()),
      dimension_(dimension),
      on_sphere_(on_sphere),
      beyond_{0, {none_yet, none_yet, none_yet}},
      without_data_(beyond_) {
  ranks.collective_try([&] {
    const std::vector<double> x = coordinates_of(placement, dimension, context);
    nodes_ = std::ssize(x) / dimension;
    std::vector<double> values(static_cast<std::size_t>(nodes_));
    std::vector<std::int32_t> inside(values.size());
    grid.evaluate(nodes_, x.data(), values.data(), inside.data());
    for (std::int64_t i = 0; i < nodes_; ++i) {
      const std::int32_t kind = inside[static_cast<std::size_t>(i)];
      Point<3> place{};
      std::copy_n(x.data() + dimension * i, dimension, place.begin());
      if (kind == NamedGrid::beyond_edge) count(beyond_, place);
      if (kind == NamedGrid::without_data) count(without_data_, place);
      positive_ += values[static_cast<std::size_t>(i)] > 0;
      negative_ += values[static_cast<std::size_t>(i)] < 0;
    }
  });
  add_up(ranks);
}

void GridCoverage::count(Nodes& nodes, const Point<3>& place) const {
  ++nodes.count;
  nodes.first = std::min(nodes.first, place);
}

void GridCoverage::add_up(const Ranks& ranks) {
  struct Counts {
    std::int64_t nodes, positive, negative;
    Nodes beyond, without_data;
  };
  const Counts own{nodes_, positive_, negative_, beyond_, without_data_};
  nodes_ = positive_ = negative_ = beyond_.count = without_data_.count = 0;
  for (const Counts& its : ranks.gather(std::vector<Counts>{own})) {
    nodes_ += its.nodes;
    positive_ += its.positive;
    negative_ += its.negative;
    for (const auto& [all, some] :
         {std::pair{&beyond_, &its.beyond}, std::pair{&without_data_, &its.without_data}}) {
      all->count += some->count;
      all->first = std::min(all->first, some->first);
    }
  }
}

std::string GridCoverage::grid_in_words() const {
  return "the grid '" + name_ + "' (" + path_ + ")";
}

std::string GridCoverage::text_of(const Nodes& nodes, const std::string& what) const {
  return "of " + std::to_string(nodes_) + " nodes, " + std::to_string(nodes.count) + " lie " +
         what + ", one of them at " + place_text(nodes.first.data(), dimension_, on_sphere_);
}

std::string GridCoverage::nowhere_message() const {
  std::string words = grid_in_words() + " has no value anywhere in the domain: ";
  if (beyond_.count > 0) words += text_of(beyond_, "beyond its edge");
  if (beyond_.count > 0 && without_data_.count > 0) words += "; ";
  if (without_data_.count > 0) words += text_of(without_data_, "where it has no data");
  return words;
}

std::string GridCoverage::beyond_message() const {
  if (beyond_.count == 0) return "";
  return grid_in_words() +
         " covers only a part of the domain: " + text_of(beyond_, "beyond its edge") +
         "; there its values are those at the edge";
}

std::string GridCoverage::without_data_message() const {
  if (without_data_.count == 0) return "";
  return grid_in_words() +
         " has gaps in the domain: " + text_of(without_data_, "where it has no data") +
         "; there its values are those of the nearest cells with data";
}

std::string GridCoverage::dry_message(const DepthRequest& request) const {
  if (nodes_ == 0 || (request.elevations ? negative_ : positive_) > 0) return "";
  return std::string(DepthRequest::option) + ": " + grid_in_words() + " has no water at any of " +
         std::to_string(nodes_) + " nodes, which count as the least depth: " +
         (request.elevations ? "are its values depths, positive down? Then leave out the word 'up'"
                             : "are its values elevations, positive up? Then add the word 'up'");
}

constexpr Box<3> all_degrees{{-180, -90, 0}, {180, 90, 0}};

Box<3> bounds_of(pnpbs_domain domain, pnpbs_context context) {
  Box<3> box{};
  check(pnpbs_domain_bounds(domain, box.low.data(), box.high.data()), context);
  return box;
}

// Returns a text such as "from (0, 0) to (1, 1)".
template <int Dim>
MessageText extent_in(const Box<3>& box, const Box<3>& within) {
  Box<Dim> boxes[2];
  for (std::size_t k = 0; k < Dim; ++k)
    for (const int which : {0, 1}) {
      boxes[which].low[k] = (which == 0 ? box : within).low[k];
      boxes[which].high[k] = (which == 0 ? box : within).high[k];
    }
  return extent_text<Dim>(boxes[0], boxes[1]);
}

}  // namespace

NamedGrids::NamedGrids(const Arguments& arguments, int dimension)
    : dimension_(dimension), sphere_(arguments.sphere.has_value()), depth_(arguments.depth_rule) {
  for (const std::string& text : arguments.spacing_grids)
    grids_.push_back(std::make_unique<NamedGrid>(text, dimension_, sphere_));
  if (depth_)
    grids_.push_back(std::make_unique<NamedGrid>(depth_->grid, dimension_, sphere_,
                                                 DepthRequest::option, "depth"));
}

std::string NamedGrids::option_of(const NamedGrid& grid) const {
  return depth_ && &grid == grids_.back().get() ? DepthRequest::option : "--spacing-grid";
}

Expression::Field NamedGrids::values_of(const NamedGrid& grid) const {
  return {grid.name(),
          [&grid](std::int64_t n, const double* x, double* there) {
            grid.evaluate(n, x, there, nullptr);
          },
          option_of(grid)};
}

Expression::Field NamedGrids::slope_of(const NamedGrid& grid) const {
  return {slope_name(grid.name()),
          [this, &grid](std::int64_t n, const double* x, double* slopes) {
            evaluate_slope(grid, dimension_, sphere_, n, x, slopes);
          },
          option_of(grid)};
}

Expression::Field NamedGrids::spacing_by_depth() const {
  const auto values = [this, &grid = *grids_.back()](std::int64_t n, const double* x, double* d) {
    const auto count = static_cast<std::size_t>(n);
    std::vector<double> depths(count), slopes(count);
    grid.evaluate(n, x, depths.data(), nullptr);
    if (depth_->rule.slope > 0) evaluate_slope(grid, dimension_, sphere_, n, x, slopes.data());
    for (std::size_t i = 0; i < count; ++i)
      d[i] = depth_->rule.spacing(depth_->elevations ? -depths[i] : depths[i], slopes[i]);
  };
  return {DepthRequest::name, values, DepthRequest::option};
}

std::vector<Expression::Field> NamedGrids::fields_in(const std::string& formula) const {
  std::vector<Expression::Field> fields;
  for (const auto& grid : grids_) {
    if (mentions(formula, grid->name())) fields.push_back(values_of(*grid));
    if (mentions(formula, slope_name(grid->name()))) fields.push_back(slope_of(*grid));
  }
  if (depth_ && mentions(formula, DepthRequest::name)) fields.push_back(spacing_by_depth());
  return fields;
}

void NamedGrids::require_use_in(const std::vector<std::string>& formulas) const {
  const auto require = [&](const std::string& name, const std::string& option) {
    for (const std::string& formula : formulas)
      if (mentions(formula, name) || mentions(formula, slope_name(name))) return;
    throw BadInput(option + ": " +
                   (formulas.size() > 1
                        ? "no formula of --spacing, --field and --open-boundary uses '"
                        : "the formula of --spacing does not use '") +
                   name + "'");
  };
  for (const auto& grid : grids_)
    if (option_of(*grid) != DepthRequest::option) require(grid->name(), option_of(*grid));
  if (depth_) require(DepthRequest::name, DepthRequest::option);
}

void NamedGrids::read(pnpbs_domain domain, pnpbs_context context, const GeoFile* geo,
                      const std::string& unit) {
  if (grids_.empty()) return;
  const std::string projection = sphere_ ? "EPSG:4326" : geo ? geo->projection().wkt : "";
  const Box<3> bounds = sphere_ ? all_degrees : bounds_of(domain, context);
  if (depth_) depth_->rule.metres = metres_per_unit(*depth_, unit);
  for (const auto& grid : grids_) grid->open(projection, bounds);
}

void NamedGrids::require_values(pnpbs_placement placement, pnpbs_domain domain,
                                pnpbs_context context, const Ranks& ranks) const {
  for (const auto& each : grids_) {
    const GridCoverage coverage(*each, placement, dimension_, sphere_, context, ranks);
    ranks.collective_try([&] {
      if (coverage.is_nowhere())
        throw BadInput(coverage.nowhere_message() + ". " +
                       extents_in_words(*each, domain, context));
    });
  }
}

// Returns the extents of the grid and the domain. On a sphere the bounding box of the domain says
// nothing about longitudes and latitudes, so only the grid's extent is given.
std::string NamedGrids::extents_in_words(const NamedGrid& grid, pnpbs_domain domain,
                                         pnpbs_context context) const {
  const Box<3> box = grid.extent();
  const std::string words = "The grid reaches ";
  if (sphere_) return words + extent_in<2>(box, all_degrees).text();
  const Box<3> bounds = bounds_of(domain, context);
  const auto extent = dimension_ == 2 ? extent_in<2> : extent_in<3>;
  return words + extent(box, bounds).text() + ", the domain " + extent(bounds, bounds).text();
}

std::vector<std::string> NamedGrids::warnings(pnpbs_placement placement, pnpbs_domain domain,
                                              pnpbs_context context, const Ranks& ranks,
                                              bool library_warns) const {
  std::vector<std::string> warnings;
  for (const auto& each : grids_) {
    const GridCoverage coverage(*each, placement, dimension_, sphere_, context, ranks);
    if (const std::string words = coverage.beyond_message(); !words.empty() && !library_warns)
      warnings.push_back(words + ". " + extents_in_words(*each, domain, context));
    if (const std::string words = coverage.without_data_message(); !words.empty())
      warnings.push_back(words);
    if (option_of(*each) != DepthRequest::option) continue;
    if (const std::string words = coverage.dry_message(*depth_); !words.empty())
      warnings.push_back(words);
  }
  return warnings;
}

}  // namespace pnpbs::tool
