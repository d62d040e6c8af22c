// SPDX-License-Identifier: BSD-3-Clause
// The values of options, from their text. All of these throw BadInput for text that is no such
// value.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tool/arguments.hpp"

namespace pnpbs::tool {

// Of this option.
void take_angle(const std::string& option, const std::string& text, std::optional<double>& angle);
void take_bound(const std::string& option, const std::string& text, std::optional<double>& bound);

void take_simplify(const std::string& text, Arguments& arguments);
void take_sphere(const std::string& text, Arguments& arguments);
void take_view(const std::string& text, Arguments& arguments);
void take_nodes(const std::string& text, Arguments& arguments);
void take_places(const std::string& text, Arguments& arguments);
void take_wall_layers(const std::string& text, Arguments& arguments);
void take_name(const std::string& text, Arguments& arguments);
void take_region(const std::string& text, Arguments& arguments);
void take_repair(const std::vector<std::string>& text, Arguments& arguments);
void take_colour(const std::string& name, Arguments& arguments);
void take_settings(const std::vector<std::string>& settings, Arguments& arguments);

}  // namespace pnpbs::tool
