// SPDX-License-Identifier: BSD-3-Clause
// Changes of the options between a checkpoint and its restart.
#pragma once

#include <string>
#include <vector>

#include "settings/options.hpp"

namespace pnpbs {

// An option with its value in the checkpoint and its present value.
struct OptionChange {
  std::string name, then, now;
};

// Returns the options that influence the nodes, as lines "name = value".
std::string lines_of_deciding(const Options& options);

// Returns the changes from these lines of a checkpoint to the present options. Throws
// Error(ErrorKind::argument) for a change that the user has not requested and for a change of an
// option that determines the spacing.
std::vector<OptionChange> changes_since(const std::string& saved_lines, const Options& now);

// Returns the changes as text for a warning.
std::string text_of(const std::vector<OptionChange>& changes);

}  // namespace pnpbs
