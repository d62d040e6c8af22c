// SPDX-License-Identifier: BSD-3-Clause
// What --depth-rule asks for: d by the depth in a raster.
#pragma once

#include <optional>
#include <string>

#include "spacing/depth_rule.hpp"

namespace pnpbs::tool {

struct DepthRequest {
  std::string text;              // as the user gives it
  std::string grid;              // [NAME=]FILE[:VARIABLE], as --spacing-grid has it
  DepthRule rule;                // but for its metres, which are
  std::optional<double> metres;  // per unit of length, if the user gives them
  bool elevations = false;       // the values are positive up

  static constexpr const char* option = "--depth-rule";
  static constexpr const char* name = "by_depth";  // of this d in formulas
};

// Throws BadInput.
DepthRequest depth_request_in(const std::string& text);

// Metres per unit of length of a domain whose unit has this name, "" if it is not known; on a
// sphere it is not. Throws BadInput where neither that nor the user says it, or both differ.
double metres_per_unit(const DepthRequest& request, const std::string& unit);

// The formula where the user gives none, with these bounds of d if there are any.
std::string formula_by_depth(const std::optional<double>& least, const std::optional<double>& most);

}  // namespace pnpbs::tool
