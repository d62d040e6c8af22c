// SPDX-License-Identifier: BSD-3-Clause
#include "tool/named_grids.hpp"

#include <algorithm>

#include "spacing/beside_domain.hpp"
#include "tool/formula_text.hpp"
#include "tool/grid_coverage.hpp"
#include "tool/grid_slope.hpp"

namespace pnpbs::tool {
namespace {

constexpr Box<3> all_degrees{{-180, -90, 0}, {180, 90, 0}};

Box<3> bounds_of(pnpbs_domain domain, pnpbs_context context) {
  Box<3> box{};
  check(pnpbs_domain_bounds(domain, box.low.data(), box.high.data()), context);
  return box;
}

// "from (0, 0) to (1, 1)"
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
    grids_.push_back(
        std::make_unique<NamedGrid>(depth_->grid, dimension_, sphere_, DepthWish::option, "depth"));
}

std::string NamedGrids::option_of(const NamedGrid& grid) const {
  return depth_ && &grid == grids_.back().get() ? DepthWish::option : "--spacing-grid";
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
  return {DepthWish::name, values, DepthWish::option};
}

std::vector<Expression::Field> NamedGrids::fields_in(const std::string& formula) const {
  std::vector<Expression::Field> fields;
  for (const auto& grid : grids_) {
    if (mentions(formula, grid->name())) fields.push_back(values_of(*grid));
    if (mentions(formula, slope_name(grid->name()))) fields.push_back(slope_of(*grid));
  }
  if (depth_ && mentions(formula, DepthWish::name)) fields.push_back(spacing_by_depth());
  return fields;
}

void NamedGrids::require_use_in(const std::vector<std::string>& formulas) const {
  const auto require = [&](const std::string& name, const std::string& option) {
    for (const std::string& formula : formulas)
      if (mentions(formula, name) || mentions(formula, slope_name(name))) return;
    throw BadInput(option + ": " +
                   (formulas.size() > 1 ? "no formula of --spacing and --field uses '"
                                        : "the formula of --spacing does not use '") +
                   name + "'");
  };
  for (const auto& grid : grids_)
    if (option_of(*grid) != DepthWish::option) require(grid->name(), option_of(*grid));
  if (depth_) require(DepthWish::name, DepthWish::option);
}

void NamedGrids::read(pnpbs_domain domain, pnpbs_context context, const GeoFile* geo) {
  if (grids_.empty()) return;
  const std::string projection = sphere_ ? "EPSG:4326" : geo ? geo->projection().wkt : "";
  const Box<3> bounds = sphere_ ? all_degrees : bounds_of(domain, context);
  if (depth_)
    depth_->rule.metres = metres_per_unit(*depth_, !sphere_ && geo ? geo->projection().unit : "");
  for (const auto& grid : grids_) grid->open(projection, bounds);
}

void NamedGrids::require_values(pnpbs_placement placement, pnpbs_domain domain,
                                pnpbs_context context, const Ranks& ranks) const {
  for (const auto& each : grids_) {
    const GridCoverage coverage(*each, placement, dimension_, sphere_, context, ranks);
    ranks.agreed([&] {
      if (coverage.is_nowhere())
        throw BadInput(coverage.words_for_nowhere() + ". " +
                       extents_in_words(*each, domain, context));
    });
  }
}

// Where it has data is another matter. On a sphere the box around the domain tells nothing.
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
    if (const std::string words = coverage.words_for_beyond(); !words.empty() && !library_warns)
      warnings.push_back(words + ". " + extents_in_words(*each, domain, context));
    if (const std::string words = coverage.words_for_without_data(); !words.empty())
      warnings.push_back(words);
  }
  return warnings;
}

}  // namespace pnpbs::tool
