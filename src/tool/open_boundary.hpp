// SPDX-License-Identifier: BSD-3-Clause
// The part of the boundary that --open-boundary marks as open, by a formula such as a depth.
#pragma once

#include <cstdint>
#include <string>

#include "tool/expression.hpp"
#include "tool/library.hpp"
#include "tool/named_grids.hpp"

namespace pnpbs::tool {

class OpenBoundary {
 public:
  // Parses the formula, which is greater than 0 where the boundary is open. The grids must outlive
  // this object. Throws BadInput.
  OpenBoundary(const std::string& formula, int dimension, const NamedGrids& grids);

  const std::string& formula() const { return text_; }

  // Gives a tag named "open" to those segments of the outline: that of a group whose name begins
  // with "open", or a new one. Returns their number. The grids must have been read. Local. Throws
  // BadInput if there are none, and Failure.
  std::int64_t tag(pnpbs_domain domain, pnpbs_context context);

 private:
  std::string text_;
  Expression formula_;
};

}  // namespace pnpbs::tool
