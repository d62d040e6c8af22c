// SPDX-License-Identifier: BSD-3-Clause
#include "tool/spacing.hpp"

#include "tool/interrupt.hpp"

namespace pnpbs::tool {
namespace {

std::int32_t evaluate(std::int64_t n, std::int32_t /*dim*/, const double* xyz, double* d,
                      void* user) {
  if (interrupted()) return 1;
  try {
    static_cast<const Expression*>(user)->at(n, xyz, d);
    return 0;
  } catch (...) {
    return 1;
  }
}

}  // namespace

Spacing::Spacing(const Arguments& arguments, int dimension) {
  if (arguments.spacing_grid.empty()) {
    expression_ = std::make_unique<Expression>(arguments.spacing, dimension);
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
    check(pnpbs_placement_set_spacing_callback(placement, evaluate, expression_.get()), context);
  }
}

}  // namespace pnpbs::tool
