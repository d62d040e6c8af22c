// SPDX-License-Identifier: BSD-3-Clause
#include "tool/spacing.hpp"

#include <array>
#include <string_view>

#include "base/small_letters.hpp"
#include "tool/spacing_hints.hpp"

namespace pnpbs::tool {

std::optional<SpacingFile> spacing_file(const std::string& text) {
  constexpr std::array<std::string_view, 3> endings{".vtu", ".msh", ".csv"};
  const std::string small = to_lower_case(text);
  for (const std::string_view ending : endings)
    if (small.size() > ending.size() && small.ends_with(ending)) return SpacingFile{text, ""};
  for (const std::string_view ending : endings) {
    const std::size_t at = small.find(std::string(ending) + ":");
    if (at == std::string::npos || at == 0) continue;
    const std::size_t end = at + ending.size();
    return SpacingFile{text.substr(0, end), text.substr(end + 1)};
  }
  return std::nullopt;
}

namespace {

// Parameters of --spacing auto.
constexpr double nodes_per_turn = 20, nodes_across = 3, nodes_per_edge = 1, growth = 0.15;

std::int32_t call_grid(std::int64_t n, std::int32_t dim, const double* coordinates, double* d,
                       void* user) {
  const Grid& grid = *static_cast<const Grid*>(user);
  for (std::int64_t i = 0; i < n; ++i) d[i] = value_at(grid, coordinates + dim * i, dim);
  return 0;
}

// Returns the formula of d. Without --spacing, d is the depth rule or the first grid.
std::string formula_in(const Arguments& arguments, const NamedGrids& grids) {
  if (!arguments.spacing.empty()) return arguments.spacing;
  return arguments.depth_rule ? formula_by_depth(arguments.min_spacing, arguments.max_spacing)
                              : grids.first().name();
}

}  // namespace

Spacing::Spacing(const Arguments& arguments, int dimension, const NamedGrids& grids)
    : dimension_(dimension),
      min_(arguments.min_spacing.value_or(0)),
      max_(arguments.max_spacing.value_or(0)) {
  if (!arguments.spacing_hints.empty())
    hints_ = read_spacing_hints(arguments.spacing_hints, dimension, arguments.sphere.has_value());
  if (arguments.spacing == "auto") return;
  file_ = spacing_file(arguments.spacing);
  if (file_) return;
  formula_ = formula_in(arguments, grids);
  if (arguments.spacing.empty() && !arguments.sphere && !arguments.depth_rule)
    grid_ = &grids.first();
  else
    expression_ = std::make_unique<Expression>(
        formula_, dimension, "--spacing",
        arguments.sphere ? Expression::Names::shape_on_sphere : Expression::Names::shape_too,
        grids.fields_in(formula_));
}

void Spacing::use_read_grids(const NamedGrids& grids) {
  if (!grid_) return;
  if (const Grid* const text = grid_->text_grid())
    return require_spacings(*text, grid_->path(), dimension_);
  expression_ =
      std::make_unique<Expression>(formula_, dimension_, "--spacing-grid",
                                   Expression::Names::coordinates, grids.fields_in(formula_));
}

const Grid* Spacing::grid() const { return expression_ || !grid_ ? nullptr : grid_->text_grid(); }

void Spacing::simplify(pnpbs_domain domain, pnpbs_context context, double tolerance,
                       double smallest) {
  if (file_) {
    check(pnpbs_domain_simplify_by_file(domain, file_->path.c_str(), file_->field.c_str(),
                                        tolerance, smallest, nullptr, nullptr),
          context);
    return;
  }
  if (expression_) expression_->set_shape_domain(domain, context);
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
  if (expression_) expression_->set_shape_domain(body, context);
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
  set_spacing(placement, domain, context, ranks);
  if (hints_.empty()) return;
  // The hints belong to the first rank, because each rank passes its own.
  const std::int64_t numbers = ranks.is_first() ? std::ssize(hints_) : 0;
  check(pnpbs_placement_add_spacing_hints(placement, numbers / dimension_, hints_.data()), context);
}

void Spacing::set_spacing(pnpbs_placement placement, pnpbs_domain domain, pnpbs_context context,
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
  if (expression_) ranks.collective_try([&] { expression_->set_shape_domain(domain, context); });
  if (expression_) expression_->use_threads();
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

}  // namespace pnpbs::tool
