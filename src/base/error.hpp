// SPDX-License-Identifier: BSD-3-Clause
// Errors are exceptions inside the library; src/api turns them into status and message.
#pragma once

#include <stdexcept>
#include <string>

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

class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  // With the text of another, which needs no memory.
  Error(ErrorKind kind, const Error& text) : std::runtime_error(text), kind_(kind) {}
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
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

}  // namespace pnpbs
