// SPDX-License-Identifier: BSD-3-Clause
// Reading the domain from a file or from standard input.
#pragma once

#include <string>

#include "tool/library.hpp"
#include "tool/ranks.hpp"

namespace pnpbs::tool {

// path "-" is standard input, of the first rank; files are read by every rank. Collective. Throws
// Failure.
void read_domain(const std::string& path, pnpbs_domain domain, pnpbs_context context,
                 const Ranks& ranks);

}  // namespace pnpbs::tool
