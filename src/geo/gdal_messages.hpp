// SPDX-License-Identifier: BSD-3-Clause
// Capture of GDAL's messages. During its lifetime, an object receives the messages of this thread,
// which GDAL would write to standard error.
#pragma once

#include <cpl_error.h>

#include <string>

namespace pnpbs::geo {

// The first failure and the first warning of GDAL on this thread. Not copyable, since GDAL has its
// address.
class GdalMessages {
 public:
  GdalMessages() { CPLPushErrorHandlerEx(take, this); }
  GdalMessages(const GdalMessages&) = delete;
  GdalMessages& operator=(const GdalMessages&) = delete;
  ~GdalMessages() { CPLPopErrorHandler(); }

  bool failed() const { return !failure_.empty(); }
  const std::string& failure() const { return failure_; }  // the first failure, or ""
  const std::string& warning() const { return warning_; }  // the first warning, or ""
  void forget() { failure_ = warning_ = ""; }

 private:
  static void CPL_STDCALL take(CPLErr grade, CPLErrorNum, const char* message) {
    GdalMessages& self = *static_cast<GdalMessages*>(CPLGetErrorHandlerUserData());
    if (grade >= CE_Failure && self.failure_.empty()) self.failure_ = message;
    if (grade == CE_Warning && self.warning_.empty()) self.warning_ = message;
  }

  std::string failure_, warning_;
};

}  // namespace pnpbs::geo
