// SPDX-License-Identifier: BSD-3-Clause
// The values of --depth-rule, which derives d from the depth in a raster.
#pragma once

#include <optional>
#include <string>

#include "spacing/depth_rule.hpp"

namespace pnpbs::tool {

struct DepthRequest {
  std::string text;              // as given on the command line
  std::string grid;              // [NAME=]FILE[:VARIABLE], as for --spacing-grid
  DepthRule rule;                // without metres per unit, which are in `metres`
  std::optional<double> metres;  // metres per unit of length, if given
  bool elevations = false;       // whether the values are positive upwards

  static constexpr const char* option = "--depth-rule";
  static constexpr const char* name = "by_depth";  // name of this d in formulas
};

// Parses the value of --depth-rule. Throws BadInput.
DepthRequest depth_request_in(const std::string& text);

// Returns the metres per unit of length of a domain with a unit of this name. `unit` is "" if it is
// unknown, as on a sphere. Throws BadInput if neither `unit` nor the request defines the factor, or
// if the two disagree.
double metres_per_unit(const DepthRequest& request, const std::string& unit);

// Returns the default formula of d by depth, with these bounds of d if present.
std::string formula_by_depth(const std::optional<double>& least, const std::optional<double>& most);

}  // namespace pnpbs::tool
