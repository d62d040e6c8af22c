// SPDX-License-Identifier: BSD-3-Clause
// Suggestions for misspelled names: "Did you mean ...?"
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace pnpbs::tool {

// Returns the name that `text` differs from by the fewest typing errors, or "" if none is similar.
std::string nearest_name(std::string_view text, std::span<const std::string> names);

// Returns "; did you mean x?" or "".
std::string did_you_mean(std::string_view text, std::span<const std::string> names);

}  // namespace pnpbs::tool
