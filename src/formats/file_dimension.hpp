// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace pnpbs {

// Of the domain that a file describes, 2 or 3: by the ending of its name, of .poly by the second
// number in it, of .msh by what it holds. Throws Error(ErrorKind::file) if a .msh cannot be read;
// what else is not known to be in space is taken to be in the plane.
int file_dimension(const std::string& path);

}  // namespace pnpbs
