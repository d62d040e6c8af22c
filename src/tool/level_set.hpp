// SPDX-License-Identifier: BSD-3-Clause
// A body as the command is given it by a formula: "levelset(-2,-2,-2, 2,2,2, 0.1, x^2+y^2+z^2-1)".
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tool/expression.hpp"
#include "tool/library.hpp"

namespace pnpbs::tool {

class LevelSet {
 public:
  // Nothing if the text does not begin as one, or names a file. Throws BadInput.
  static std::unique_ptr<LevelSet> in(const std::string& text);

  // This object must outlive the domain, and placements in it.
  void add_to(pnpbs_domain domain, pnpbs_context context) const;

 private:
  LevelSet(std::vector<double> numbers, const std::string& formula);

  std::vector<double> numbers_;  // two corners of the box, and the resolution
  Expression f_;
};

}  // namespace pnpbs::tool
