// SPDX-License-Identifier: BSD-3-Clause
#include "tool/spacing.hpp"

#include "spacing/beside_domain.hpp"
#include "tool/grid_coverage.hpp"
#include "tool/grid_slope.hpp"

namespace pnpbs::tool {
namespace {

// What --spacing auto asks for.
constexpr double nodes_per_turn = 20, nodes_across = 3, nodes_per_edge = 1, growth = 0.15;

constexpr Box<3> all_degrees{{-180, -90, 0}, {180, 90, 0}};

std::int32_t call_grid(std::int64_t n, std::int32_t dim, const double* coordinates, double* d,
                       void* user) {
  const Grid& grid = *static_cast<const Grid*>(user);
  for (std::int64_t i = 0; i < n; ++i) d[i] = value_at(grid, coordinates + dim * i, dim);
  return 0;
}

Box<3> bounds_of(pnpbs_domain domain, pnpbs_context context) {
  Box<3> box{};
  check(pnpbs_domain_bounds(domain, box.low.data(), box.high.data()), context);
  return box;
}

// "from (0, 0) to (1, 1)"
template <int Dim>
std::string extent_in(const Box<3>& box, const Box<3>& within) {
  Box<Dim> boxes[2];
  for (std::size_t k = 0; k < Dim; ++k)
    for (const int which : {0, 1}) {
      boxes[which].low[k] = (which == 0 ? box : within).low[k];
      boxes[which].high[k] = (which == 0 ? box : within).high[k];
    }
  return extent_text<Dim>(boxes[0], boxes[1]);
}

}  // namespace

Spacing::Spacing(const Arguments& arguments, int dimension)
    : dimension_(dimension),
      sphere_(arguments.sphere.has_value()),
      min_(arguments.min_spacing.value_or(0)),
      max_(arguments.max_spacing.value_or(0)),
      depth_(arguments.depth_rule) {
  if (arguments.spacing == "auto") return;
  file_ = spacing_file(arguments.spacing);
  if (file_) return;
  const bool alone = arguments.spacing.empty();
  const std::string formula = alone && depth_
                                  ? formula_by_depth(arguments.min_spacing, arguments.max_spacing)
                                  : arguments.spacing;
  std::vector<Expression::Field> fields = fields_for(formula, arguments);
  if (!sphere_ && alone && !depth_ && grids_[0]->text_grid()) return;
  expression_ = std::make_unique<Expression>(
      formula.empty() ? grids_[0]->name() : formula, dimension, "--spacing",
      sphere_ ? Expression::Names::shape_on_sphere : Expression::Names::shape_too,
      std::move(fields));
}

// Opens the grids. Of that of the depth a formula may have the values as well.
std::vector<Expression::Field> Spacing::fields_for(const std::string& formula,
                                                   const Arguments& arguments) {
  std::vector<Expression::Field> fields;
  const auto add = [&](const NamedGrid* grid, bool values, const std::string& option) {
    if (values)
      fields.push_back({grid->name(),
                        [grid](std::int64_t n, const double* x, double* there) {
                          grid->evaluate(n, x, there, nullptr);
                        },
                        option});
    if (mentions(formula, slope_name(grid->name())))
      fields.push_back({slope_name(grid->name()),
                        [this, grid](std::int64_t n, const double* x, double* slopes) {
                          evaluate_slope(*grid, dimension_, sphere_, n, x, slopes);
                        },
                        option});
  };
  for (const std::string& text : arguments.spacing_grids) {
    grids_.push_back(std::make_unique<NamedGrid>(text, dimension_, sphere_));
    add(grids_.back().get(), true, "--spacing-grid");
  }
  if (depth_) {
    grids_.push_back(
        std::make_unique<NamedGrid>(depth_->grid, dimension_, sphere_, DepthWish::option, "depth"));
    const NamedGrid* grid = grids_.back().get();
    add(grid, mentions(formula, grid->name()), DepthWish::option);
    fields.push_back(field_by_depth(grid));
  }
  return fields;
}

Expression::Field Spacing::field_by_depth(const NamedGrid* grid) {
  const auto values = [this, grid](std::int64_t n, const double* x, double* d) {
    const auto count = static_cast<std::size_t>(n);
    std::vector<double> depths(count), slopes(count);
    grid->evaluate(n, x, depths.data(), nullptr);
    if (depth_->rule.slope > 0) evaluate_slope(*grid, dimension_, sphere_, n, x, slopes.data());
    for (std::size_t i = 0; i < count; ++i)
      d[i] = depth_->rule.spacing(depth_->elevations ? -depths[i] : depths[i], slopes[i]);
  };
  return {DepthWish::name, values, DepthWish::option};
}

const Grid* Spacing::grid() const {
  return expression_ || grids_.empty() ? nullptr : grids_[0]->text_grid();
}

void Spacing::read_grids(pnpbs_domain domain, pnpbs_context context, const GeoFile* geo) {
  if (grids_.empty()) return;
  const std::string projection = sphere_ ? "EPSG:4326" : geo ? geo->projection().wkt : "";
  const Box<3> bounds = sphere_ ? all_degrees : bounds_of(domain, context);
  if (depth_)
    depth_->rule.metres = metres_per_unit(*depth_, !sphere_ && geo ? geo->projection().unit : "");
  for (const auto& each : grids_) {
    each->open(projection, bounds);
    if (expression_ || each->text_grid()) continue;
    expression_ = std::make_unique<Expression>(
        each->name(), dimension_, "--spacing-grid", Expression::Names::coordinates,
        std::vector<Expression::Field>{
            {each->name(), [grid = each.get()](std::int64_t n, const double* x, double* values) {
               grid->evaluate(n, x, values, nullptr);
             }}});
  }
}

void Spacing::simplify(pnpbs_domain domain, pnpbs_context context, double tolerance,
                       double smallest) {
  if (file_) {
    check(pnpbs_domain_simplify_by_file(domain, file_->path.c_str(), file_->field.c_str(),
                                        tolerance, smallest, nullptr, nullptr),
          context);
    return;
  }
  if (expression_) expression_->ask_shape_of(domain, context);
  const Multiplied d = callback();
  check(pnpbs_domain_simplify(domain, d.d, d.user, tolerance, smallest, nullptr, nullptr), context);
}

Spacing::Multiplied Spacing::callback() const {
  if (grid()) return {call_grid, const_cast<Grid*>(grid()), 1};
  return {call_expression, expression_->as_user(), 1};
}

std::int32_t Spacing::call_multiplied(std::int64_t n, std::int32_t dim, const double* coordinates,
                                      double* d, void* user) {
  const Multiplied& it = *static_cast<const Multiplied*>(user);
  const std::int32_t status = it.d(n, dim, coordinates, d, it.user);
  for (std::int64_t i = 0; i < n; ++i) d[i] *= it.factor;
  return status;
}

void Spacing::add_band(pnpbs_domain domain, pnpbs_domain body, const Band& band,
                       pnpbs_context context) {
  if (expression_) expression_->ask_shape_of(body, context);
  const Multiplied d = callback();
  constexpr std::int32_t tag = 1;
  check(pnpbs_domain_add_offset(domain, body, band.from, band.to, d.d, d.user, 0, tag), context);
}

void Spacing::multiply(double factor) {
  bubbles_ = callback();
  bubbles_->factor = factor;
}

void Spacing::give_to(pnpbs_placement placement, pnpbs_domain domain, pnpbs_context context,
                      const Ranks& ranks) {
  if (file_) {
    check(pnpbs_placement_set_spacing_file(placement, file_->path.c_str(), file_->field.c_str()),
          context);
    return;
  }
  if (!grid() && !expression_) {
    check(pnpbs_placement_set_spacing_from_shape(placement, nodes_per_turn, nodes_across,
                                                 nodes_per_edge, growth, min_, max_),
          context);
    return;
  }
  if (expression_) ranks.agreed([&] { expression_->ask_shape_of(domain, context); });
  const bool is_constant = expression_ && expression_->is_constant();
  if (is_constant) {
    constexpr double anywhere[3] = {0, 0, 0};
    const double factor = bubbles_ ? bubbles_->factor : 1;
    check(pnpbs_placement_set_spacing_constant(placement, factor * expression_->at(anywhere)),
          context);
  } else if (bubbles_) {
    check(pnpbs_placement_set_spacing_callback(placement, call_multiplied, &*bubbles_), context);
  } else if (grid()) {
    check(set_grid(placement), context);
  } else {
    check(pnpbs_placement_set_spacing_callback(placement, call_expression, expression_->as_user()),
          context);
  }
}

pnpbs_status Spacing::set_grid(pnpbs_placement placement) const {
  return pnpbs_placement_set_spacing_grid(placement, grid()->size, grid()->origin, grid()->step,
                                          grid()->values.data());
}

void Spacing::require_values_of_grids(pnpbs_placement placement, pnpbs_domain domain,
                                      pnpbs_context context, const Ranks& ranks) const {
  if (!expression_) return;
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
std::string Spacing::extents_in_words(const NamedGrid& grid, pnpbs_domain domain,
                                      pnpbs_context context) const {
  const Box<3> box = grid.extent();
  const std::string words = "The grid reaches ";
  if (sphere_) return words + extent_in<2>(box, all_degrees);
  const Box<3> bounds = bounds_of(domain, context);
  const auto extent = dimension_ == 2 ? extent_in<2> : extent_in<3>;
  return words + extent(box, bounds) + ", the domain " + extent(bounds, bounds);
}

std::vector<std::string> Spacing::warnings(pnpbs_placement placement, pnpbs_domain domain,
                                           pnpbs_context context, const Ranks& ranks) const {
  std::vector<std::string> warnings;
  if (!expression_) return warnings;
  for (const auto& each : grids_) {
    const GridCoverage coverage(*each, placement, dimension_, sphere_, context, ranks);
    if (const std::string words = coverage.words_for_beyond(); !words.empty())
      warnings.push_back(words + ". " + extents_in_words(*each, domain, context));
    if (const std::string words = coverage.words_for_without_data(); !words.empty())
      warnings.push_back(words);
  }
  return warnings;
}

}  // namespace pnpbs::tool
