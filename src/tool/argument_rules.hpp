// SPDX-License-Identifier: BSD-3-Clause
// Which arguments go together, and with which domains.
#pragma once

#include <string>

#include "tool/arguments.hpp"

namespace pnpbs::tool {

// Throws BadInput that names --help.
[[noreturn]] void refuse(const std::string& what);

// Those that are missing, and those that exclude or need one another. Throws BadInput.
void require_arguments_that_fit(const Arguments& arguments);

// Files of particles want their volumes, and some their density. Throws BadInput.
void ask_for_what_files_need(Arguments& arguments);

// What only domains of the other dimension have. Throws BadInput.
void refuse_other_dimension(const Arguments& arguments, int dimension);

}  // namespace pnpbs::tool
