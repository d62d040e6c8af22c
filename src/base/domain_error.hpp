// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "base/error.hpp"

namespace pnpbs {

// Says that a domain cannot be what was given, and where.
[[noreturn]] inline void reject_domain(const std::string& message) {
  throw Error(ErrorKind::domain, message);
}

// Triangles that enclose a body badly, which may be repaired.
class BrokenSurface : public Error {
 public:
  explicit BrokenSurface(const std::string& message) : Error(ErrorKind::domain, message) {}
};

}  // namespace pnpbs
