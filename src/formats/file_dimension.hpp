// SPDX-License-Identifier: BSD-3-Clause
// The dimension of the domain that a file describes.
#pragma once

#include <string>

namespace pnpbs {

// Returns the dimension, 2 or 3. It follows from the extension of the file, for .poly from the
// second number in it and for .msh from its nodes and elements. Files of unknown format count as
// plane. Throws Error(ErrorKind::file) if a .msh cannot be read.
int file_dimension(const std::string& path);

}  // namespace pnpbs
