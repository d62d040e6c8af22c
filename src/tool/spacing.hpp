// SPDX-License-Identifier: BSD-3-Clause
// The spacing the user asked for, in the form that suits the library best.
#pragma once

#include <memory>
#include <optional>

#include "tool/arguments.hpp"
#include "tool/expression.hpp"
#include "tool/grid_file.hpp"
#include "tool/library.hpp"
#include "tool/ranks.hpp"
#include "tool/spacing_file.hpp"

namespace pnpbs::tool {

class Spacing {
 public:
  Spacing(const Arguments& arguments, int dimension);

  // Leaves out of a domain in the plane what is finer than d. Local. Throws Failure.
  void simplify(pnpbs_domain domain, pnpbs_context context, double tolerance, double smallest);

  // This object must outlive the placement, and the domain, whose shape a formula may ask for.
  // Collective. Throws Failure.
  void give_to(pnpbs_placement placement, pnpbs_domain domain, pnpbs_context context,
               const Ranks& ranks);

 private:
  double min_, max_;                        // of auto, 0: none
  std::unique_ptr<Expression> expression_;  // none of these: auto
  std::unique_ptr<Grid> grid_;
  std::optional<SpacingFile> file_;
};

}  // namespace pnpbs::tool
