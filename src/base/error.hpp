// SPDX-License-Identifier: BSD-3-Clause
// Exceptions of the library, which src/api converts to a status and a message.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "base/message_text.hpp"

namespace pnpbs {

// Category of an error. The public interface has a status for each (pnpbs_status).
enum class ErrorKind {
  stopped,  // the monitor stopped the run; the caller gets no error
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

// Detail of an error that the public interface reports as a constant PNPBS_REASON_...
enum class ErrorReason {
  other,
  crossing  // curves cross or overlap
};

// An exception with a kind, a reason and a message that may name points.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, MessageText message, ErrorReason reason = ErrorReason::other)
      : Error(kind, std::make_shared<const MessageText>(as_worded(std::move(message))), reason) {}
  // Creates an error of another kind with the message of `other`. Allocates no memory.
  Error(ErrorKind kind, const Error& other)
      : std::runtime_error(other), kind_(kind), reason_(other.reason_), message_(other.message_) {}
  ErrorKind kind() const { return kind_; }
  ErrorReason reason() const { return reason_; }
  // Returns the text of what() together with the points that it names.
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

// Messages for exceptions that are not of type Error.
inline constexpr const char* kOutOfMemory =
    "out of memory: fewer nodes (a larger spacing) or more memory is needed";
inline constexpr const char* kArrayTooLong =
    "out of memory: an array would be larger than can be addressed";
inline constexpr const char* kForeignException =
    "a callback threw something that is no std::exception";

// Returns the shortest text that reads back as the same double, with a decimal point in every
// locale. Messages and reports show numbers in this form.
std::string number_text(double value);

// Returns true if fewer nodes or more memory could avoid the error.
inline bool is_lack_of_room(const Error& error) {
  return error.kind() == ErrorKind::spacing || error.kind() == ErrorKind::memory;
}

// Throws the error that a domain is invalid. `message` names the location.
[[noreturn]] inline void reject_domain(const MessageText& message,
                                       ErrorReason reason = ErrorReason::other) {
  throw Error(ErrorKind::domain, message, reason);
}

// An error of a surface whose triangles do not enclose a body. A repair of the triangles may
// succeed.
class BrokenSurface : public Error {
 public:
  explicit BrokenSurface(const MessageText& message) : Error(ErrorKind::domain, message) {}
};

}  // namespace pnpbs
