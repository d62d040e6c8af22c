// SPDX-License-Identifier: BSD-3-Clause
// The spacing the user asked for, in the form that suits the library best.
#pragma once

#include <memory>

#include "tool/arguments.hpp"
#include "tool/expression.hpp"
#include "tool/grid_file.hpp"
#include "tool/library.hpp"

namespace pnpbs::tool {

class Spacing {
 public:
  Spacing(const Arguments& arguments, int dimension);

  // This object must outlive the placement.
  void give_to(pnpbs_placement placement, pnpbs_context context) const;

 private:
  std::unique_ptr<Expression> expression_;
  std::unique_ptr<Grid> grid_;
};

}  // namespace pnpbs::tool
