// SPDX-License-Identifier: BSD-3-Clause
// A file that several ranks write at the same time, each at its own offsets.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace pnpbs {

// A file opened for writing.
class SharedWriter {
 public:
  virtual ~SharedWriter() = default;  // closes the file if it is open; ignores errors
  // Write at an offset in bytes, and close the file. Local. Both throw Error(ErrorKind::file).
  virtual void write_at(std::int64_t place, std::span<const char> bytes) = 0;
  virtual void close() = 0;
};

// Opens an existing file for one process by plain system calls. `name` stands for the file in error
// messages.
std::unique_ptr<SharedWriter> open_alone(const std::string& path, const std::string& name);

}  // namespace pnpbs
