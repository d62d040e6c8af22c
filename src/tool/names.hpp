// SPDX-License-Identifier: BSD-3-Clause
// "Did you mean ...?"
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace pnpbs::tool {

// The name that takes the fewest typing errors to become `text`; "" if none is near.
std::string nearest_name(std::string_view text, std::span<const std::string> names);

// "; did you mean x?" or "".
std::string did_you_mean(std::string_view text, std::span<const std::string> names);

}  // namespace pnpbs::tool
