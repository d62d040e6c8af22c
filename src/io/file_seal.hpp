// SPDX-License-Identifier: BSD-3-Clause
// A checksum ("seal") at the end of a file that protects its structure. A library that parses the
// structure then need not be robust against damage. HDF5 ignores bytes after the end of its data.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pnpbs::io {

// A range of bytes that the checksum does not cover, because it is checked otherwise and written
// later.
struct Extent {
  std::int64_t begin, size;
};

// Append the checksum, or require that it is right. `name` is the name of the file in messages.
// Both throw Error(ErrorKind::file).
void add_seal(const std::string& path, const std::string& name, std::vector<Extent> left_out);
void require_seal(const std::string& path, const std::string& name);

}  // namespace pnpbs::io
