// SPDX-License-Identifier: BSD-3-Clause
// Conversion of warnings to the text that a checkpoint stores.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/warning.hpp"

namespace pnpbs {

// Returns the warnings as text. Each warning is a line "code count value points length" of its
// numbers, a line "dimension rounded begin end x y z" for each point that it names, and its
// message.
std::string saved_warnings(std::span<const Warning> warnings);

// Returns the warnings of such a text. Throws Error(ErrorKind::file) if it is damaged.
std::vector<Warning> warnings_in(const std::string& saved);

}  // namespace pnpbs
