// SPDX-License-Identifier: BSD-3-Clause
#include "tool/spacing.hpp"

namespace pnpbs::tool {

Spacing::Spacing(const Arguments& arguments, int dimension) {
  if (arguments.spacing_grid.empty()) {
    expression_ = std::make_unique<Expression>(arguments.spacing, dimension, "--spacing");
  } else {
    grid_ = std::make_unique<Grid>(read_grid(arguments.spacing_grid, dimension));
  }
}

void Spacing::give_to(pnpbs_placement placement, pnpbs_context context) const {
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
