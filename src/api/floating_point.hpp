// SPDX-License-Identifier: BSD-3-Clause
// Whose rules floating-point arithmetic goes by. Hosts trap exceptions (gfortran's -ffpe-trap),
// flush small numbers to zero (-ffast-math) or round their own way; our vector loops divide by what
// they then mask away, and our results must not depend on the host. So every call computes by the
// default rules, and callbacks by the host's. Worker threads have the rules of the thread that
// started them: ours the default ones, and those of a host that used OpenMP before its first call
// its own.
#pragma once

#include <cfenv>

namespace pnpbs::api {

// The rules of the host whose call is in progress on this thread.
inline thread_local const std::fenv_t* host_arithmetic = nullptr;

// For the length of a call: the default rules; then the host's again, its flags as they were.
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
  const std::fenv_t* outer_;  // of a call in whose callback we are
  std::fenv_t host_;
};

// For the length of a callback: the host's rules.
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
