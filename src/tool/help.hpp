// SPDX-License-Identifier: BSD-3-Clause
// Help texts that are generated from the tables of the library.
#pragma once

#include <string>

namespace pnpbs::tool {

std::string help_tables();      // formats, formulas, options of the library, exit codes
std::string statistics_text();  // the keys of the report
std::string version_text();

}  // namespace pnpbs::tool
