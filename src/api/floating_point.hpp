// SPDX-License-Identifier: BSD-3-Clause
// Floating-point environments of calls and callbacks. The host may trap exceptions (gfortran's
// -ffpe-trap), flush small numbers to zero (-ffast-math) or use another rounding mode. The vector
// loops of the library divide by zero in lanes that they mask afterwards, and results must not
// depend on the host. Every call therefore computes in the default environment, and callbacks run
// in that of the host. Worker threads have the environment of the thread that started them, which
// is the default one if this library starts them.
#pragma once

#include <cfenv>

namespace pnpbs::api {

// The environment of the host program whose call is in progress on this thread.
inline thread_local const std::fenv_t* host_arithmetic = nullptr;

// A scope with the default environment. At the end the host's environment is restored with its
// flags.
class DefaultArithmetic {
 public:
  DefaultArithmetic() : outer_(host_arithmetic) {
    std::fegetenv(&host_);
    host_arithmetic = &host_;
    std::fesetenv(FE_DFL_ENV);
  }
  DefaultArithmetic(const DefaultArithmetic&) = delete;
  DefaultArithmetic& operator=(const DefaultArithmetic&) = delete;
  ~DefaultArithmetic() {
    host_arithmetic = outer_;
    std::fesetenv(&host_);
  }

 private:
  const std::fenv_t* outer_;  // of an outer call, whose callback made this call
  std::fenv_t host_;
};

// A scope with the host's environment, for callbacks.
class HostArithmetic {
 public:
  HostArithmetic() {
    if (host_arithmetic) std::fesetenv(host_arithmetic);
  }
  HostArithmetic(const HostArithmetic&) = delete;
  HostArithmetic& operator=(const HostArithmetic&) = delete;
  ~HostArithmetic() { std::fesetenv(FE_DFL_ENV); }
};

}  // namespace pnpbs::api
