// SPDX-License-Identifier: BSD-3-Clause
// A file that several ranks write parts of at the same time, each at its own place.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace pnpbs {

class SharedWriter {
 public:
  virtual ~SharedWriter() = default;  // closes if nobody has; not told if that fails
  // Local, both. Throw Error(ErrorKind::file).
  virtual void write_at(std::int64_t place, std::span<const char> bytes) = 0;
  virtual void close() = 0;
};

// One process alone, by plain system calls. The file must exist. `name` is for messages.
std::unique_ptr<SharedWriter> open_alone(const std::string& path, const std::string& name);

}  // namespace pnpbs
