// SPDX-License-Identifier: BSD-3-Clause
// Warnings in the form in which a checkpoint stores them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/warning.hpp"

namespace pnpbs {

// Each warning is a line of its numbers, "code count value points length", a line
// "dimension rounded begin end x y z" for each point that it names, and its text.
std::string saved_warnings(std::span<const Warning> warnings);

// Throws Error(ErrorKind::file) if the text is none of saved_warnings().
std::vector<Warning> warnings_in(const std::string& saved);

}  // namespace pnpbs
