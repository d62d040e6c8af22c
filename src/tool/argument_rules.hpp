// SPDX-License-Identifier: BSD-3-Clause
// Rules about combinations of command-line arguments, and about arguments that apply to one
// dimension only.
#pragma once

#include <string>

#include "tool/arguments.hpp"

namespace pnpbs::tool {

// Throws BadInput with `what` and a hint at --help.
[[noreturn]] void refuse(const std::string& what);

// Throws BadInput if required arguments are missing, or if arguments exclude or require one
// another.
void require_arguments_that_fit(const Arguments& arguments);

// Requests volumes if an output format stores particles. Throws BadInput if such a format also
// requires a density and none is given.
void request_data_for_formats(Arguments& arguments);

// Throws BadInput if an argument is given that applies only to domains of another dimension.
void refuse_other_dimension(const Arguments& arguments, int dimension);

}  // namespace pnpbs::tool
