// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace pnpbs {

// The bytes of a file. Throws Error(ErrorKind::file, "path: cannot be read: ...").
std::string read_whole_file(const std::string& path);

}  // namespace pnpbs
