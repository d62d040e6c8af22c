// SPDX-License-Identifier: BSD-3-Clause
#include "tool/spacing.hpp"

namespace pnpbs::tool {
namespace {

// What --spacing auto asks for.
constexpr double nodes_per_turn = 20, nodes_across = 3, nodes_per_edge = 1, growth = 0.15;

std::int32_t call_grid(std::int64_t n, std::int32_t dim, const double* coordinates, double* d,
                       void* user) {
  const Grid& grid = *static_cast<const Grid*>(user);
  for (std::int64_t i = 0; i < n; ++i) d[i] = value_at(grid, coordinates + dim * i);
  return 0;
}

}  // namespace

Spacing::Spacing(const Arguments& arguments, int dimension)
    : min_(arguments.min_spacing.value_or(0)), max_(arguments.max_spacing.value_or(0)) {
  if (arguments.spacing == "auto") return;
  file_ = spacing_file(arguments.spacing);
  if (file_) return;
  if (arguments.spacing_grid.empty()) {
    expression_ = std::make_unique<Expression>(arguments.spacing, dimension, "--spacing",
                                               Expression::Names::shape_too);
  } else {
    grid_ = std::make_unique<Grid>(read_grid(arguments.spacing_grid, dimension));
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
  check(pnpbs_domain_simplify(domain, grid_ ? call_grid : call_expression,
                              grid_ ? grid_.get() : expression_->as_user(), tolerance, smallest,
                              nullptr, nullptr),
        context);
}

void Spacing::give_to(pnpbs_placement placement, pnpbs_domain domain, pnpbs_context context,
                      const Ranks& ranks) {
  if (file_) {
    check(pnpbs_placement_set_spacing_file(placement, file_->path.c_str(), file_->field.c_str()),
          context);
    return;
  }
  if (!grid_ && !expression_) {
    check(pnpbs_placement_set_spacing_from_shape(placement, nodes_per_turn, nodes_across,
                                                 nodes_per_edge, growth, min_, max_),
          context);
    return;
  }
  if (expression_) ranks.agreed([&] { expression_->ask_shape_of(domain, context); });
  if (grid_) {
    check(pnpbs_placement_set_spacing_grid(placement, grid_->size, grid_->origin, grid_->step,
                                           grid_->values.data()),
          context);
  } else if (expression_->is_constant()) {
    constexpr double anywhere[3] = {0, 0, 0};
    check(pnpbs_placement_set_spacing_constant(placement, expression_->at(anywhere)), context);
  } else {
    check(pnpbs_placement_set_spacing_callback(placement, call_expression, expression_->as_user()),
          context);
  }
}

}  // namespace pnpbs::tool
