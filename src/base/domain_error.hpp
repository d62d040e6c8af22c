// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/error.hpp"

namespace pnpbs {

// Says that a domain cannot be what was given, and where.
[[noreturn]] inline void reject_domain(const MessageText& message,
                                       ErrorReason reason = ErrorReason::other) {
  throw Error(ErrorKind::domain, message, reason);
}

// Triangles that enclose a body badly, which may be repaired.
class BrokenSurface : public Error {
 public:
  explicit BrokenSurface(const MessageText& message) : Error(ErrorKind::domain, message) {}
};

}  // namespace pnpbs
