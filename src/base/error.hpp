// SPDX-License-Identifier: BSD-3-Clause
// Errors are exceptions inside the library; src/api turns them into status and message.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "base/message_text.hpp"

namespace pnpbs {

// What went wrong, as the public interface tells it apart (pnpbs_status).
enum class ErrorKind {
  stopped,  // by the monitor: no error to the caller
  argument,
  handle,
  state,
  domain,
  spacing,
  key,
  capacity,
  file,
  callback,
  memory,
  mpi,
  kokkos,
  unsupported,
  internal
};

// Further reasons that the public interface tells apart (PNPBS_REASON_...).
enum class ErrorReason {
  other,
  crossing  // curves cross or overlap
};

class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, MessageText message, ErrorReason reason = ErrorReason::other)
      : Error(kind, std::make_shared<const MessageText>(as_worded(std::move(message))), reason) {}
  // Another kind with the message of `other`. Needs no memory.
  Error(ErrorKind kind, const Error& other)
      : std::runtime_error(other), kind_(kind), reason_(other.reason_), message_(other.message_) {}
  ErrorKind kind() const { return kind_; }
  ErrorReason reason() const { return reason_; }
  // The text of what(), and the points in it.
  const MessageText& message() const { return *message_; }

 private:
  Error(ErrorKind kind, std::shared_ptr<const MessageText> message, ErrorReason reason)
      : std::runtime_error(message->text()),
        kind_(kind),
        reason_(reason),
        message_(std::move(message)) {}

  ErrorKind kind_;
  ErrorReason reason_;
  std::shared_ptr<const MessageText> message_;
};

// What failures are told as that are no Error.
inline constexpr const char* kOutOfMemory =
    "out of memory: fewer nodes (a larger spacing) or more memory is needed";
inline constexpr const char* kArrayTooLong =
    "out of memory: an array would be larger than can be addressed";
inline constexpr const char* kForeignException =
    "a callback threw something that is no std::exception";

// A number as messages and reports show it: shortest text that reads back as the same double,
// with a point in every locale.
std::string number_text(double value);

inline bool is_lack_of_room(const Error& error) {
  return error.kind() == ErrorKind::spacing || error.kind() == ErrorKind::memory;
}

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
