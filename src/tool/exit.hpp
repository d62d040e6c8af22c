// SPDX-License-Identifier: BSD-3-Clause
// Exit codes of the command, and the exceptions that end it.
#pragma once

#include <stdexcept>
#include <string>

namespace pnpbs::tool {

enum class ExitCode {
  done = 0,
  failed = 1,
  bad_input = 2,
  not_converged = 3,
  spacing_missed = 4,
  input_left_out = 5,
  not_conforming = 6,
  interrupted = 130
};

// An exception that ends the command with a message on standard error.
class Failure : public std::runtime_error {
 public:
  Failure(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

class BadInput : public Failure {
 public:
  explicit BadInput(const std::string& message) : Failure(ExitCode::bad_input, message) {}
};

class Interrupted : public Failure {
 public:
  Interrupted() : Failure(ExitCode::interrupted, "interrupted, nothing was written") {}
};

}  // namespace pnpbs::tool
