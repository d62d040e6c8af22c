// SPDX-License-Identifier: BSD-3-Clause
// A checksum at the end of a file, of what tells where things lie in it: a library that reads it
// need then not stand up to damage. HDF5 takes no notice of what comes behind its own last byte.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pnpbs::io {

// Bytes of a file that the seal leaves out, as they are checked otherwise and may be written later.
struct Extent {
  std::int64_t begin, size;
};

// Both throw Error(ErrorKind::file); name: of the file, for messages.
void add_seal(const std::string& path, const std::string& name, std::vector<Extent> left_out);
void require_seal(const std::string& path, const std::string& name);

}  // namespace pnpbs::io
