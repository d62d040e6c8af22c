// SPDX-License-Identifier: BSD-3-Clause
// What has become of the options since a checkpoint.
#pragma once

#include <string>
#include <vector>

#include "settings/options.hpp"

namespace pnpbs {

struct OptionChange {
  std::string name, then, now;
};

// The options that decide on the nodes, "name = value" in lines.
std::string lines_of_deciding(const Options& options);

// From those lines of a checkpoint to the options there are now. Throws Error(ErrorKind::argument)
// for a change that nobody has asked for, and for one that asks for another spacing.
std::vector<OptionChange> changes_since(const std::string& saved_lines, const Options& now);

// For a warning.
std::string text_of(const std::vector<OptionChange>& changes);

}  // namespace pnpbs
